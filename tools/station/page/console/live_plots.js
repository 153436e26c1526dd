// Beside the live robot: which layers of its picture are drawn, what its colours mean, and plots of the last
// seconds. All of it by the modules of a log's page. Plots are closed at first where the screen has no room
// for them; closed ones cost a copy of each frame and nothing else.
import { add_layers, add_legend } from "layers";
import { Plots } from "plots";
import { LiveSource } from "./live_source.js";

const redraw_ms = 250; // [design choice] by software a plot takes some 10 ms
const heard_enough = 25; // frames until it is known what this robot says
const roomy = matchMedia("(min-width: 1500px) and (min-height: 900px)");
const dark = matchMedia("(prefers-color-scheme: dark)");

function element(tag, name) {
  const made = document.createElement(tag);
  made.className = name;
  return made;
}

class LivePlots {
  #heard = 0;

  /** @param view view.js's, open */
  constructor(view) {
    this.view = view;
    this.source = new LiveSource(view.layout);
    this.box = element("details", "live-plots");
    this.box.innerHTML = "<summary>Plots of the last 20 s</summary><div class='plot-tools'></div><div></div>";
    this.box.open = roomy.matches;
    view.holder.parentElement.append(this.box);
    setInterval(() => this.#redraw(), redraw_ms);
    dark.addEventListener("change", () => this.plots?.set_theme(dark.matches ? "dark" : "light"));
  }

  take(data) {
    this.row = new Float32Array(data, 8);
    this.time_s = new DataView(data).getFloat64(0, true);
    this.source.take(this.time_s, this.row);
    this.#heard += 1;
    if (this.#heard === heard_enough && this.view.view) this.#explain();
  }

  /** Layers and legend, under the picture. */
  #explain() {
    const layers = element("div", "layers");
    layers.setAttribute("role", "group");
    layers.setAttribute("aria-label", "What is drawn");
    const legend = element("div", "legend");
    add_layers(layers, this.view.view);
    const { fields } = this.source.layout;
    const truth = fields.findIndex(({ name }) => name.endsWith(".true_contact_force_N.z"));
    add_legend(legend, this.view.scene, truth >= 0 && this.source.known[truth]);
    this.view.holder.after(layers, legend);
  }

  #redraw() {
    if (!this.box.open || this.#heard < heard_enough || document.visibilityState !== "visible") return;
    if (!this.plots) {
      this.plots = new Plots(this.box.lastChild, this.box.querySelector(".plot-tools"), this.source, () => {});
      this.plots.set_theme(dark.matches ? "dark" : "light");
    }
    this.plots.refresh();
    this.plots.show(this.time_s, this.row);
  }
}

/** Begins with the first frame. @param link link.js's @param view view.js's */
export function mountLivePlots(link, view) {
  let plots = null;
  link.addEventListener("frame", ({ detail }) => {
    if (detail.byteLength !== view.frame_bytes) return;
    plots ??= new LivePlots(view);
    plots.take(detail);
  });
  return () => plots;
}
