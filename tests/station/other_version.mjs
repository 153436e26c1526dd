// A log in which a channel's messages are of a type that nobody knows: as of another version of sprung.
// usage: other_version.mjs IN.lcm CHANNEL OUT.lcm
import { readFileSync, writeFileSync } from "node:fs";

const [from, channel, to] = process.argv.slice(2);
const head_bytes = 28; // sync word, number, time, lengths of channel and data
const log = readFileSync(from);
for (let at = 0; at + head_bytes <= log.length;) {
  if (log.readUInt32BE(at) !== 0xeda1da01) throw new Error(`${from} is no LCM log at byte ${at}`);
  const name_bytes = log.readUInt32BE(at + 20);
  const data = at + head_bytes + name_bytes;
  if (log.toString("latin1", at + head_bytes, data) === channel) log[data] ^= 0x55;
  at = data + log.readUInt32BE(at + 24);
}
writeFileSync(to, log);
