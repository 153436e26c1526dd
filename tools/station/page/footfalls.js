// Which foot stands when: a row for each leg, a few seconds around now. A gait that limps is seen here at once.
import {index_at, index_of_fields} from "source";

const kBefore_s = 1.5;
const kAfter_s = 1.0;
const kRow_px = 16;
const kColour = {light: {contact: "#0072b2", air: "#dfe5ea", ink: "#16202a"},
                 dark: {contact: "#56b4e9", air: "#2a333b", ink: "#e8edf2"}};

export class Footfalls {
  /** Draws nothing where a robot has no feet or nothing was estimated of them. */
  constructor(container, source) {
    this.source = source;
    const index = index_of_fields(source.layout);
    this.legs = source.layout.legs
      .map((leg) => ({leg, values: source.moment_column?.(index.get(`legs.${leg}.contact`)) ?? null}))
      .filter(({values}) => values !== null);
    this.theme = "light";
    if (this.legs.length === 0) return;
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "Which foot stands when, around the time shown");
    this.canvas.style.height = `${kRow_px * this.legs.length + 4}px`;
    const title = document.createElement("h2");
    title.textContent = `Feet on the ground, ${kBefore_s} s before to ${kAfter_s} s after`;
    container.append(title, this.canvas);
  }

  set_theme(theme) {
    this.theme = theme;
  }

  show(time_s) {
    if (!this.canvas) return;
    const scale = window.devicePixelRatio;
    const width = this.canvas.clientWidth;
    const height = this.canvas.clientHeight;
    if (this.canvas.width !== width * scale) this.canvas.width = width * scale;
    if (this.canvas.height !== height * scale) this.canvas.height = height * scale;
    const context = this.canvas.getContext("2d");
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, width, height);
    const label_px = 64;
    const place = (t) => label_px + (width - label_px) * (t - time_s + kBefore_s) / (kBefore_s + kAfter_s);
    this.legs.forEach((leg, row) => this.draw_leg(context, leg, row * kRow_px + 2, place, time_s, width));
    context.fillStyle = kColour[this.theme].ink;
    context.fillRect(place(time_s) - 1, 0, 2, height);
  }

  draw_leg(context, {leg, values}, top, place, time_s, width) {
    const {contact, air, ink} = kColour[this.theme];
    const times = this.source.time_s;
    const first = index_at(times, time_s - kBefore_s);
    const last = index_at(times, time_s + kAfter_s);
    context.fillStyle = air;
    context.fillRect(place(times[first]), top + 5, place(times[last]) - place(times[first]), 2);
    context.fillStyle = contact;
    for (let i = first; i < last;) {
      if (!(values[i] > 0.5)) { ++i; continue; }
      let end = i;
      while (end < last && values[end] > 0.5) ++end;
      const from = Math.max(64, place(times[i]));
      context.fillRect(from, top, Math.min(width, place(times[end])) - from, kRow_px - 4);
      i = end;
    }
    context.fillStyle = ink;
    context.font = "13px system-ui, sans-serif";
    context.fillText(leg, 0, top + 11);
  }
}
