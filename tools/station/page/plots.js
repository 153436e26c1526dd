// Plots beside the robot that follow its time. Colours are Okabe and Ito's, told apart by the colour-blind, and
// each curve has dashes of its own besides.
import uPlot from "uplot";
import {index_of_fields, word_of} from "source";

const kColours = {
  light: ["#0072b2", "#d55e00", "#007a5a", "#a3477a", "#7a6400", "#1f6f9f", "#444444", "#b8860b"],
  dark: ["#56b4e9", "#e69f00", "#2fc99b", "#e39bc4", "#f0e442", "#8fc7ea", "#cccccc", "#d55e00"],
};
const kDashes = [[], [8, 4], [2, 3], [10, 3, 2, 3]];
const kHeight_px = 170;
const kMostCurves = 8;

/** What can be chosen: by name, the fields that it shows, each as a curve. */
export function plot_choices(layout) {
  const of = (items, list, member) => items.map((item) => ({name: `${list}.${item}.${member}`, label: item}));
  const joints = (member) => of(layout.joints, "joints", member);
  const legs = (member) => of(layout.legs, "legs", member);
  const axes = (name) => ["x", "y", "z"].map((axis) => ({name: `${name}.${axis}`, label: axis}));
  const choices = [
    {title: "Torque at the gear's output", curves: joints("gear_output_torque_Nm")},
    {title: "Vertical foot force, estimated", curves: legs("foot_force_N.z")},
    {title: "Vertical foot force, simulation's truth", curves: legs("true_contact_force_N.z")},
    {title: "Joint position, estimated", curves: joints("estimated_position_rad")},
    {title: "Joint position, desired", curves: joints("desired_position_rad")},
    {title: "Joint velocity, estimated", curves: joints("estimated_velocity_rad_s")},
    {title: "External torque, estimated", curves: joints("external_torque_Nm")},
    {title: "Friction torque, estimated", curves: joints("friction_torque_Nm")},
    {title: "Motor-side torque, the papers'", curves: joints("motor_side_torque_Nm")},
    {title: "Torque, commanded", curves: of(layout.actuators, "actuators", "commanded_torque_Nm")},
    {title: "Motor current, measured", curves: of(layout.actuators, "actuators", "measured_current_A")},
    {title: "Supply voltage, measured", curves: of(layout.actuators, "actuators", "measured_supply_V")},
    {title: "Gear temperature, estimated", curves: joints("estimated_temperature_degC")},
    {title: "Drive temperature, measured", curves: of(layout.actuators, "actuators", "measured_temperature_degC")},
    {title: "Battery voltage", curves: [{name: "auxiliary.battery_voltage_V", label: "voltage"}]},
    {title: "Battery charge, share", curves: [{name: "auxiliary.battery_charge_share", label: "charge"}]},
    {title: "Battery temperature", curves: [{name: "auxiliary.battery_temperature_degC", label: "temperature"}]},
    {title: "Contact, 0 or 1", curves: legs("contact")},
    {title: "Phase of each leg", curves: legs("phase")},
    {title: "Trunk height", curves: [{name: "trunk.z_m", label: "height"}]},
    {title: "Trunk along the floor", curves: [{name: "trunk.x_m", label: "x"}, {name: "trunk.y_m", label: "y"}]},
    {title: "Trunk's place by odometry", curves: axes("odometry.estimated_position_in_world_m")},
    {title: "Feet that slipped, by odometry", curves: [{name: "odometry.slips", label: "so far"}]},
    {title: "Trunk velocity, estimated", curves: axes("body.estimated_velocity_m_s")},
    {title: "Specific force, measured", curves: axes("imu.measured_specific_force_m_s2")},
    {title: "Angular velocity, measured", curves: axes("imu.measured_angular_velocity_rad_s")},
    {title: "State of the motion", curves: [{name: "motion.state", label: "state"}]},
    {title: "Safety level", curves: [{name: "safety.level", label: "level"}]},
  ];
  const index = index_of_fields(layout);
  for (const choice of choices) choice.curves = choice.curves.filter(({name}) => index.has(name));
  return choices.filter((choice) => choice.curves.length > 0);
}

/** At most this many points are drawn of a curve, twice the pixels of a wide plot; lowest and highest stay. */
const kMostPoints = 4000;

/** Points of a field between two times: (time, value) where each is one cycle, else lowest then highest. */
export function points_of(series, begin, end) {
  const each = Math.max(1, Math.ceil((end - begin) / (kMostPoints / 2)));
  if (each === 1 && series.low === series.high)
    return {x: Array.from(series.time_s.subarray(begin, end)), y: Array.from(series.low.subarray(begin, end), real)};
  const x = [], y = [];
  for (let i = begin; i < end; i += each) {
    let low = Infinity, high = -Infinity;
    for (let k = i; k < Math.min(end, i + each); ++k) {
      if (series.low[k] < low) low = series.low[k];
      if (series.high[k] > high) high = series.high[k];
    }
    const none = low > high;
    x.push(series.time_s[i], series.time_s[i]);
    y.push(none ? null : low, none ? null : high);
  }
  return {x, y};
}
function real(value) { return Number.isNaN(value) ? null : value; }

/** One plot and the box in which it is chosen. */
class Plot {
  constructor(plots, choice) {
    this.plots = plots;
    this.box = document.createElement("figure");
    this.box.className = "plot";
    this.head = document.createElement("figcaption");
    this.select = document.createElement("select");
    this.select.setAttribute("aria-label", "What this plot shows");
    plots.choices.forEach((one, i) => this.select.add(new Option(one.title, String(i))));
    this.select.value = String(choice);
    this.select.addEventListener("change", () => this.choose(Number(this.select.value)));
    const close = document.createElement("button");
    close.type = "button";
    close.textContent = "×";
    close.setAttribute("aria-label", "Take this plot away");
    close.addEventListener("click", () => plots.remove(this));
    this.key = document.createElement("div");
    this.key.className = "key";
    this.area = document.createElement("div");
    this.head.append(this.select, close);
    this.box.append(this.head, this.area, this.key);
    this.choice = choice;
  }

  choose(choice) {
    this.choice = choice;
    this.make();
  }

  /** Curves of which there are values. */
  known() {
    const {source, index} = this.plots;
    return this.plots.choices[this.choice].curves
      .map((curve) => ({...curve, field: index.get(curve.name)}))
      .filter(({field}) => source.series(field) !== null);
  }

  make() {
    this.chart?.destroy();
    this.now = null;
    const {layout, source} = this.plots;
    const curves = this.known();
    this.offered = curves.length;
    this.curves = curves.slice(0, kMostCurves);
    this.area.replaceChildren();
    this.key.replaceChildren();
    this.chart = null;
    if (this.curves.length === 0) {
      this.area.textContent = source.live ? "Nothing of this has been heard yet." : "Nothing of this is in the log.";
      return;
    }
    const unit = layout.fields[this.curves[0].field].unit;
    this.chart = new uPlot(this.options(unit), this.data(...this.plots.span()), this.area);
    this.make_key(curves.length - this.curves.length, unit);
  }

  options(unit) {
    const theme = this.plots.theme;
    const dark = theme === "dark";
    const line = {stroke: dark ? "#c3ccd5" : "#3a444d", grid: {stroke: dark ? "#2d363e" : "#dde2e6", width: 1},
                  ticks: {stroke: dark ? "#2d363e" : "#dde2e6", width: 1}, font: "12px system-ui, sans-serif"};
    return {
      width: Math.max(200, this.plots.width()), height: kHeight_px, legend: {show: false},
      cursor: {drag: {x: true, y: false}, points: {show: false}},
      scales: {x: {time: false}},
      axes: [{...line, size: 32}, {...line, size: 58, label: unit, labelSize: 16, labelFont: line.font}],
      series: [{}, ...this.curves.map((curve, i) => ({
        label: curve.label, stroke: kColours[theme][i % kColours[theme].length],
        dash: kDashes[i % kDashes.length], width: 1.4, points: {show: false}, spanGaps: false,
      }))],
      hooks: {
        draw: [() => this.place_now()],
        ready: [(chart) => this.listen(chart)],
        setSelect: [(chart) => this.plots.zoom_to(chart.posToVal(chart.select.left, "x"),
                                                  chart.posToVal(chart.select.left + chart.select.width, "x"))],
      },
    };
  }

  /** The time shown is a line above the plot: it moves without the curves being drawn again. */
  place_now() {
    if (!this.now) return;
    const x = this.chart.valToPos(this.plots.time_s, "x");
    const inside = x >= 0 && x <= this.chart.over.clientWidth;
    this.now.hidden = !inside;
    if (inside) this.now.style.transform = `translateX(${x}px)`;
  }

  listen(chart) {
    this.now = document.createElement("div");
    this.now.className = "now";
    chart.over.append(this.now);
    chart.over.addEventListener("click", (event) => {
      const x = event.clientX - chart.over.getBoundingClientRect().left;
      this.plots.on_seek(chart.posToVal(x, "x"));  // uPlot keeps the click at the end of a drag to itself
    });
    chart.over.addEventListener("dblclick", () => this.plots.zoom_to());
  }

  data(from_s, to_s) {
    const all = this.curves.map(({field}) => this.plots.source.series(field));
    const time_s = all[0].time_s;
    const begin = Math.max(0, time_s.findIndex((t) => t >= from_s) - 1);
    let end = begin;
    while (end < time_s.length && time_s[end] <= to_s) ++end;
    const points = all.map((series) => points_of(series, begin, Math.min(time_s.length, end + 1)));
    return [points[0].x, ...points.map(({y}) => y)];
  }

  refresh() {
    if (this.known().length !== this.offered) return this.make();
    if (!this.chart) return;
    const span = this.plots.span();
    this.chart.setData(this.data(...span), false);
    this.chart.setScale("x", {min: span[0], max: span[1]});
  }

  make_key(left_out, unit) {
    const colours = kColours[this.plots.theme];
    this.values = this.curves.map((curve, i) => {
      const entry = document.createElement("span");
      const line = document.createElement("i");
      line.style.borderTopColor = colours[i % colours.length];
      line.style.borderTopStyle = ["solid", "dashed", "dotted", "double"][i % kDashes.length];
      const value = document.createElement("b");
      entry.append(line, `${curve.label} `, value);
      this.key.append(entry);
      return value;
    });
    if (left_out > 0) this.key.append(`and ${left_out} more`);
    this.unit = unit;
  }

  follow(row) {
    if (!this.chart) return;
    this.curves.forEach((curve, i) => {
      const field = this.plots.layout.fields[curve.field];
      const value = row[curve.field];
      const text = field.words ? word_of(field, value) : Number.isNaN(value) ? "-" : number_text(value);
      if (this.values[i].textContent !== text) this.values[i].textContent = text;
    });
    this.place_now();
  }
}

export function number_text(value) {
  const size = Math.abs(value);
  return value.toFixed(size >= 100 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

export class Plots {
  /** @param on_seek (time_s) a place in a plot was clicked */
  constructor(container, tools, source, on_seek) {
    this.container = container;
    this.source = source;
    this.layout = source.layout;
    this.index = index_of_fields(this.layout);
    this.choices = plot_choices(this.layout)
      .filter((choice) => source.live || choice.curves.some(({name}) => source.series(this.index.get(name)) !== null));
    this.on_seek = on_seek;
    this.theme = "light";
    this.time_s = 0;
    this.plots = [];
    this.zoom = null;
    const add = document.createElement("button");
    add.type = "button";
    add.textContent = "Add a plot";
    add.addEventListener("click", () => this.add(this.free_choice()));
    const whole = document.createElement("button");
    whole.type = "button";
    whole.textContent = "Whole time";
    whole.addEventListener("click", () => this.zoom_to());
    tools.append(add, whole, source.live ? "Drag in a plot to zoom." : "Drag in a plot to zoom, click to go there.");
    for (let i = 0; i < Math.min(3, this.choices.length); ++i) this.add(i);
    new ResizeObserver(() => this.resize()).observe(container);
  }

  free_choice() {
    const used = new Set(this.plots.map((plot) => plot.choice));
    return Math.max(0, this.choices.findIndex((_, i) => !used.has(i)));
  }
  add(choice) {
    const plot = new Plot(this, choice);
    this.plots.push(plot);
    this.container.append(plot.box);
    plot.make();
  }
  remove(plot) {
    plot.chart?.destroy();
    plot.box.remove();
    this.plots = this.plots.filter((other) => other !== plot);
  }
  width() {
    return this.container.clientWidth;
  }
  resize() {
    for (const plot of this.plots) plot.chart?.setSize({width: Math.max(200, this.width()), height: kHeight_px});
  }
  span() {
    return this.zoom ?? this.source.range();
  }
  /** All of it without arguments. */
  zoom_to(from_s, to_s) {
    const least_s = 0.002;
    if (from_s !== undefined && !(to_s - from_s > least_s)) return;
    this.zoom = from_s === undefined ? null : [from_s, to_s];
    for (const plot of this.plots) {
      plot.chart?.setSelect({left: 0, width: 0, top: 0, height: 0}, false);
      plot.refresh();
    }
  }
  set_theme(theme) {
    this.theme = theme;
    for (const plot of this.plots) plot.make();
  }
  show(time_s, row) {
    this.time_s = time_s;
    for (const plot of this.plots) plot.follow(row);
  }
  /** New data of a live source. */
  refresh() {
    for (const plot of this.plots) plot.refresh();
  }
}
