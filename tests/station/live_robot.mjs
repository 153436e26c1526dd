// A simulated robot in real time with its live page, on ports and in a folder of its own.
import { spawn, spawnSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createSocket } from "node:dgram";
import os from "node:os";
import path from "node:path";

const up_ms = 60_000;

/** A UDP port that nobody has now. */
function freePort() {
  return new Promise((resolve) => {
    const socket = createSocket("udp4");
    socket.bind(0, "127.0.0.1", () => {
      const { port } = socket.address();
      socket.close(() => resolve(port));
    });
  });
}

export const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

/** @param condition may return a promise. @throws with `what` where it does not come true in time. */
export async function eventually(what, condition, timeout_ms = 30_000) {
  for (const end = Date.now() + timeout_ms; ; await pause(50)) {
    const result = await condition();
    if (result) return result;
    if (Date.now() > end) throw new Error(`not within ${timeout_ms / 1000} s: ${what}`);
  }
}

export class LiveRobot {
  /** @param bin folder of the programs. @param robot name, or folder of one. */
  static async up(bin, robot, buses) {
    const live = new LiveRobot();
    live.bin = bin;
    live.folder = mkdtempSync(path.join(os.tmpdir(), "sprung-console-"));
    live.env = { ...process.env, SPRUNG_PROGRAMS: bin, SPRUNG_RUN_DIR: live.folder, SPRUNG_MIXED_BUILDS: "1", SPRUNG_STATE_DIR: live.folder };
    const can = [];
    live.ports = {};
    for (const bus of buses) {
      live.ports[bus] = await freePort();
      can.push("--can", `${bus}=udp:239.74.163.2:${live.ports[bus]}`);
    }
    const url = `udpm://239.255.76.67:${await freePort()}?ttl=0&recv_buf_size=4194304`;
    live.process = live.start("up.txt", ["up", robot, "--sim", "--no-record", "--plain", "--lcm-url", url, ...can]);
    try {
      await live.says("up.txt", "is up");
    } catch (error) {
      await live.down();
      throw error;
    }
    return live;
  }

  start(file, words) {
    const child = spawn("/bin/sh", ["-c", `exec "$0" "$@" > ${path.join(this.folder, file)} 2>&1`, path.join(this.bin, "sprung"), ...words],
                        { env: this.env, stdio: "ignore" });
    child.on("exit", (status) => { child.status = status ?? -1; });
    return child;
  }

  said(file) {
    try {
      return readFileSync(path.join(this.folder, file), "utf8");
    } catch {
      return "";
    }
  }

  async says(file, what) {
    await eventually(`${file} says '${what}': ${this.said(file)}`, () => this.said(file).includes(what), up_ms);
  }

  /** @return the page's address. */
  async console(words = []) {
    writeFileSync(path.join(this.folder, "console.txt"), "");
    this.server = this.start("console.txt", ["console", "--port", "0", ...words]);
    await this.says("console.txt", "http://");
    return this.said("console.txt").match(/http:\S+/)[0];
  }

  /** `sprung ...` to its end. */
  sprung(...words) {
    const { status, stdout, stderr } = spawnSync(path.join(this.bin, "sprung"), words, { env: this.env, encoding: "utf8" });
    return { status, text: stdout + stderr };
  }

  status() {
    return JSON.parse(this.sprung("status", "--json").text);
  }

  /** Like sprung(). @throws where it fails, with what it said. */
  do(...words) {
    const { status, text } = this.sprung(...words);
    if (status !== 0) throw new Error(`sprung ${words.join(" ")}: exit status ${status}: ${text}`);
    return text;
  }

  /** Writes channels into a log in the robot's folder. @return its end() gives the log's path */
  async record(file, channels) {
    const log = path.join(this.folder, file);
    const recorder = this.start(`${file}.txt`, ["record", log, "--channels", channels]);
    await eventually(`${file} is begun: ${this.said(`${file}.txt`)}`, () => existsSync(log) || recorder.status !== undefined);
    return { end: async () => {
      recorder.kill("SIGINT");
      await eventually("sprung record ends", () => recorder.status !== undefined);
      return log;
    } };
  }

  async down() {
    this.server?.kill("SIGTERM");
    this.process.kill("SIGINT");
    try {
      await eventually("sprung up ends", () => this.process.status !== undefined, up_ms);
    } finally {
      rmSync(this.folder, { recursive: true, force: true });
    }
  }
}
