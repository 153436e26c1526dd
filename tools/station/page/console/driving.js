// Keyboard and gamepad: what they say goes to the server, which decides whether the robot may move by it
// (locks, dead-man, age). Nothing is sent while the page is hidden.

const send_ms = 50;
const keys = { w: ["forward", 1], s: ["forward", -1], a: ["turning", 1], d: ["turning", -1], q: ["left", 1], e: ["left", -1] };
const clamp = (value) => Math.max(-1, Math.min(1, value));

/** Standard mapping: left stick goes, right stick turns, either shoulder button is the dead-man, B stops. */
function gamepadSticks(pad) {
  return {
    source: `gamepad ${pad.index}: ${pad.id}`.slice(0, 80),
    forward: clamp(-pad.axes[1]), left: clamp(-pad.axes[0]), turning: clamp(-(pad.axes[2] ?? 0)),
    dead_man: Boolean(pad.buttons[4]?.pressed || pad.buttons[5]?.pressed),
  };
}

export class Driving {
  #held = new Set();

  /** @param options elements `source` and `gait` (selects); estop: called when a gamepad's B is pressed. */
  constructor(link, { source, gait, estop }) {
    Object.assign(this, { link, source, gait, estop });
    addEventListener("keydown", (event) => this.#key(event, true));
    addEventListener("keyup", (event) => this.#key(event, false));
    addEventListener("blur", () => this.#held.clear());
    document.addEventListener("visibilitychange", () => this.#held.clear());
    for (const type of ["gamepadconnected", "gamepaddisconnected"]) addEventListener(type, () => this.#listPads());
    setInterval(() => this.#send(), send_ms);
    this.#listPads();
  }

  #key(event, down) {
    const typing = event.target instanceof HTMLInputElement;
    if (this.source.value !== "keyboard" || !(event.key.toLowerCase() in keys) || event.ctrlKey || event.metaKey || event.altKey) return;
    if (typing && down) return;
    event.preventDefault();
    if (event.target instanceof HTMLSelectElement) event.target.blur();
    if (down) this.#held.add(event.key.toLowerCase());
    else this.#held.delete(event.key.toLowerCase());
    this.#send();
  }

  #keyboardSticks() {
    const sticks = { source: "keyboard", forward: 0, left: 0, turning: 0, dead_man: this.#held.size > 0 };
    for (const key of this.#held) sticks[keys[key][0]] = clamp(sticks[keys[key][0]] + keys[key][1]);
    return sticks;
  }

  #pads() {
    return [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad && pad.axes.length >= 2);
  }

  #listPads() {
    for (const option of [...this.source.options].slice(2)) option.remove();
    for (const pad of this.#pads()) this.source.append(new Option(`gamepad: ${pad.id} (L1 or R1 held: it goes; B stops)`, `pad${pad.index}`));
  }

  #send() {
    const pads = this.#pads();
    if (pads.length !== this.source.options.length - 2) this.#listPads();
    if (pads.some((pad) => pad.buttons[1]?.pressed)) this.estop();
    if (document.visibilityState !== "visible" || this.source.value === "") return;
    const pad = pads.find((each) => this.source.value === `pad${each.index}`);
    if (this.source.value !== "keyboard" && !pad) return;
    const sticks = pad ? gamepadSticks(pad) : this.#keyboardSticks();
    const gait = this.gait.value === "" ? {} : { gait: Number(this.gait.value) };
    this.link.send({ type: "sticks", ...sticks, ...gait });
  }
}
