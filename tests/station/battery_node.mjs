// A battery on a simulated CAN bus: a node that answers SDO with CiA 418's objects (docs/drivers.md, Battery).
import { createSocket } from "node:dgram";

const group = "239.74.163.2"; // of live_robot.mjs
const node = 20;
const expedited = { 1: 0x4f, 2: 0x4b, 4: 0x43 };

/** Arbitration id and data of a datagram as python-can's udp_multicast sends it (msgpack). */
function frameOf(datagram) {
  const behind = (key) => datagram.indexOf(key, 0, "latin1") + key.length;
  const at = behind("arbitration_id");
  const id = { 0xcd: () => datagram.readUInt16BE(at + 1), 0xce: () => datagram.readUInt32BE(at + 1) }[datagram[at]]?.() ?? datagram[at];
  const data = behind("\xa4data"); // bin 8: 0xc4, length
  return { id, data: datagram.subarray(data + 2, data + 2 + datagram[data + 1]) };
}

function datagramOf(id, data) {
  const text = (word) => Buffer.from([0xa0 | word.length, ...Buffer.from(word)]);
  const time = Buffer.alloc(9, 0xcb);
  time.writeDoubleBE(Date.now() / 1000, 1);
  const fields = [["timestamp", time], ["arbitration_id", Buffer.from([0xcd, id >> 8, id & 0xff])], ["is_extended_id", Buffer.from([0xc2])],
    ["dlc", Buffer.from([data.length])], ["data", Buffer.from([0xc4, data.length, ...data])]];
  return Buffer.concat([Buffer.from([0x80 | fields.length]), ...fields.flatMap(([key, value]) => [text(key), value])]);
}

/** @param objects {index: [value, bytes]} @return a function that takes it off the bus */
export async function batteryOn(port, objects) {
  const socket = createSocket({ type: "udp4", reuseAddr: true });
  await new Promise((resolve) => socket.bind(port, group, resolve));
  socket.addMembership(group, "127.0.0.1");
  const sender = createSocket("udp4");
  await new Promise((resolve) => sender.bind(0, "127.0.0.1", resolve));
  sender.setMulticastInterface("127.0.0.1");
  sender.setMulticastTTL(0);
  socket.on("message", (datagram) => {
    const { id, data } = frameOf(datagram);
    if (id !== 0x600 + node || data[0] !== 0x40) return; // an SDO upload's request
    const [value, bytes] = objects[data.readUInt16LE(1)] ?? [0, 0];
    const answer = Buffer.from([expedited[bytes] ?? 0x80, data[1], data[2], data[3], 0, 0, 0, 0]);
    if (bytes) answer.writeIntLE(value, 4, bytes);
    else answer.writeUInt32LE(0x06020000, 4); // no such object
    sender.send(datagramOf(0x580 + node, answer), port, group);
  });
  let there = true;
  return () => {
    if (there) for (const each of [socket, sender]) each.close();
    there = false;
  };
}
