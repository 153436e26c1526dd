// What the robot says, in panels. Numbers that nobody has measured are a dash.

const text = (value, digits = 1) => (value === null || value === undefined ? "–" : value.toFixed(digits).replace(/^-(0\.?0*)$/, "$1"));
const byId = (id) => document.getElementById(id);
const degrees = (value) => (value === null || value === undefined ? "–" : `${((value * 180) / Math.PI).toFixed(1)}°`);

function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (key === "class") made.className = value;
    else made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

/** Only what has changed is written: a page that is read aloud stays silent, and drawing stays cheap. */
function show(target, value) {
  if (target.textContent !== value) target.textContent = value;
}
function mark(target, name) {
  if (target.className !== name) target.className = name;
}

/** A value with its bound about a zero in the middle; full scale is the limit. */
class Bar {
  constructor(name, scale, unit) {
    this.scale = scale;
    this.unit = unit;
    this.band = element("i");
    this.bar = element("b");
    this.number = element("span", { class: "number" });
    this.row = element("div", { class: "row" }, element("span", { class: "name", title: name }, name),
      element("div", { class: "bar", "aria-hidden": "true" }, this.band, this.bar), this.number);
  }

  #place(target, from, to) {
    const percent = (value) => 50 + 50 * Math.max(-1, Math.min(1, value / this.scale));
    target.style.left = `${percent(Math.min(from, to))}%`;
    target.style.width = `${percent(Math.max(from, to)) - percent(Math.min(from, to))}%`;
  }

  set(value, bound) {
    const known = value !== null && value !== undefined;
    show(this.number, known ? `${text(value)} ±${text(bound)} ${this.unit}` : `– ${this.unit}`);
    this.#place(this.bar, 0, known ? value : 0);
    this.#place(this.band, known ? value - (bound ?? 0) : 0, known ? value + (bound ?? 0) : 0);
  }
}

/** Rows of cells, in a table whose cells are kept. */
class Table {
  constructor(target, headings) {
    this.body = element("tbody");
    const cells = headings.map((heading) => element("th", { scope: "col" }, heading));
    target.replaceChildren(element("table", {}, element("thead", {}, element("tr", {}, ...cells)), this.body));
    this.columns = headings.length;
  }

  set(rows) {
    while (this.body.rows.length > rows.length) this.body.deleteRow(-1);
    while (this.body.rows.length < rows.length) {
      const row = this.body.insertRow();
      for (let i = 0; i < this.columns; ++i) row.insertCell();
    }
    rows.forEach((cells, r) => cells.forEach((cell, c) => {
      const { value, bad } = typeof cell === "object" ? cell : { value: cell, bad: false };
      show(this.body.rows[r].cells[c], value);
      mark(this.body.rows[r].cells[c], bad ? "bad" : "");
    }));
  }
}

/** CiA 402's states without power are one to an operator; faults and stops keep their words. */
const off = ["switch on disabled", "not ready to switch on", "ready to switch on", "switched on"];
const power = (state) => (state === "operation enabled" ? "on" : off.includes(state) ? "off" : state);

const safety_class = { operational: "good", disabled: "warn", damping: "warn", lowering: "warn", "quick stop": "bad" };

export class Panels {
  constructor(robot) {
    this.robot = robot;
    byId("robot").textContent = `${robot.robot}${robot.simulation ? " (simulated)" : ""}${robot.maintenance ? ", maintenance" : ""}`;
    this.joints = robot.joints.map((joint) => new Bar(joint.name, joint.torque_limit_Nm ?? 100, "Nm"));
    byId("joints").replaceChildren(...this.joints.map((bar) => bar.row));
    const weight_N = 400; // full scale of a foot's force; a bar that is full says so by its number
    this.feet = robot.legs.map((leg) => new Bar(`${leg.name} z`, weight_N, "N"));
    byId("feet").replaceChildren(...this.feet.map((bar) => bar.row));
    this.#drive_table([]);
    this.processes = new Table(byId("processes"), ["process", "state", "Hz", "CPU %", "overruns"]);
    this.buses = new Table(byId("buses"), ["bus", "condition", "load %", "errors"]);
    byId("legs").replaceChildren(...robot.legs.map(() => element("li")));
    this.facts = new Map();
  }

  /** Columns of temperatures, where the robot has any: its own estimate of the gears, what drives measure. */
  #drive_table(temperatures) {
    this.temperatures = temperatures;
    this.drives = new Table(byId("drives"), ["drive", "power", "A", "V", ...temperatures.map(({ heading }) => heading)]);
  }

  /** Where nothing was heard of a temperature yet, it has no column. */
  #known_temperatures(state) {
    const measured = state.auxiliary?.temperatures_degC ?? {};
    const gear = { heading: "gear °C", of: (_, i) => state.joints[i]?.temperature_degC };
    const drive = { heading: "drive °C", of: (name) => measured[name] };
    const all = [];
    if (state.joints.some((joint) => Number.isFinite(joint.temperature_degC))) all.push(gear);
    if (Object.keys(measured).length > 0) all.push(drive);
    return all;
  }

  #battery(battery) {
    byId("battery").hidden = !battery;
    if (!battery) return;
    const share = battery.charge_share === null ? null : 100 * battery.charge_share;
    const low = battery.low ? ". LOW: let the robot sit, then charge" : "";
    show(byId("battery"), `Battery ${text(share, 0)} %, ${text(battery.voltage_V)} V, ${text(battery.temperature_degC)} °C${low}`);
    mark(byId("battery"), battery.low ? "battery low" : "battery");
  }

  #fact(name, value) {
    if (!this.facts.has(name)) {
      const dd = element("dd");
      byId("body").append(element("div", {}, element("dt", {}, name), dd));
      this.facts.set(name, dd);
    }
    show(this.facts.get(name), value);
  }

  update(state) {
    this.#safety(state.safety);
    this.#motion(state);
    state.joints.forEach((joint, i) => this.joints[i].set(joint.torque_Nm, joint.torque_bound_Nm));
    state.legs.forEach((leg, i) => this.feet[i].set(leg.force_N[2], leg.force_bound_N[2]));
    this.#tables(state);
  }

  #safety(safety) {
    const old = safety.stale ? ` (nothing heard for ${text(safety.age_s)} s)` : "";
    show(byId("safety-state"), `${safety.state}${old}`);
    const detail = safety.detail ? `: ${safety.detail}` : "";
    show(byId("safety-cause"), safety.cause === "none" ? safety.detail ?? "" : `${safety.cause}${detail}`);
    show(byId("safety-next"), safety.next ? `What to do: ${safety.next}` : "");
    mark(byId("safety"), `safety ${safety_class[safety.state] ?? "bad"}`);
  }

  #motion(state) {
    const motion = state.motion;
    const gait = motion.gait ? `, ${motion.gait}` : "";
    show(byId("motion"), `${motion.state}${gait}${motion.last_transition ? `: ${motion.last_transition}` : ""}`);
    [...byId("legs").children].forEach((item, i) => {
      const leg = motion.legs[i], foot = state.legs[i];
      show(item, `${this.robot.legs[i].name}: ${leg ? leg.phase : "?"}${foot?.contact ? ", on the ground" : ""}`);
      mark(item, foot?.contact ? "contact" : "");
    });
    const body = state.body;
    if (!body) return;
    this.#fact("roll", degrees(body.roll_rad));
    this.#fact("pitch", degrees(body.pitch_rad));
    this.#fact("yaw", degrees(body.yaw_rad));
    this.#fact("height", `${text(body.height_m, 3)} m`);
    this.#fact("speed forward", `${text(body.velocity_m_s[0], 2)} m/s`);
    this.#fact("speed left", `${text(body.velocity_m_s[1], 2)} m/s`);
  }

  #tables(state) {
    const temperatures = this.#known_temperatures(state);
    const headings = (columns) => columns.map(({ heading }) => heading).join();
    if (headings(temperatures) !== headings(this.temperatures)) this.#drive_table(temperatures);
    this.#battery(state.auxiliary?.battery);
    this.drives.set(state.actuators.map((drive, i) => [
      this.robot.actuators[i].name,
      { value: drive.fault_code ? `${power(drive.power)}, fault 0x${drive.fault_code.toString(16)}` : power(drive.power), bad: drive.fault_code !== 0 },
      text(drive.current_A, 2), text(drive.supply_V),
      ...temperatures.map(({ of }) => text(of(this.robot.actuators[i].name, i)))]));
    this.processes.set(state.processes.map((process) => [
      process.name.replace(/^sprung-/, ""),
      { value: process.state, bad: ["dead", "stopped", "silent"].includes(process.state) },
      text(process.rate_hz, 0), text(process.cpu_percent, 0), `${process.overruns ?? "–"}`]));
    const troubled = state.nodes.filter((node) => node.trouble).map((node) => [node.name, { value: node.trouble, bad: true }, "", ""]);
    this.buses.set(state.buses.map((bus) => {
      const errors = bus.error_frames + bus.send_failed + bus.dropped + bus.malformed;
      return [bus.name, { value: bus.condition, bad: bus.condition !== "active" }, text(100 * bus.load_share), { value: `${errors}`, bad: errors > 0 }];
    }).concat(troubled));
  }
}
