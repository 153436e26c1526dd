// The robot in 3-D, live: the newest frame is drawn, one a picture of the screen; frames that came between
// are left out. A browser without WebGL shows the panels alone, and says so.
import { RobotView } from "robot_view";

const slow_ms = 40; // a picture that takes longer leaves as much time to keys, sticks and the emergency stop

const json = async (path) => (await fetch(path)).json();

export class LiveView {
  #row = null;
  #counted = 0;
  #rest_until_ms = 0;
  fps = 0;
  frames = 0; // heard of the server
  pictures = 0; // drawn

  /** @param holder of the canvas; what cannot be shown is told in it. */
  constructor(holder) {
    this.holder = holder;
    this.canvas = holder.querySelector("canvas");
    this.note = document.createElement("span");
    this.note.className = "fps";
    holder.append(this.note);
    setInterval(() => this.#count(), 1000);
  }

  async open() {
    const [scene, layout] = await Promise.all([json("scene.json"), json("layout.json")]);
    this.scene = scene;
    this.layout = layout;
    this.frame_bytes = 8 + 4 * layout.fields.length;
    if (scene.missing) return this.#missing(`The robot cannot be drawn: ${scene.missing}`);
    try {
      this.view = new RobotView(this.canvas, scene, layout);
    } catch {
      return this.#missing("This browser has no WebGL, which the 3-D view needs. All else works.");
    }
    const dark = matchMedia("(prefers-color-scheme: dark)");
    const theme = () => this.view.set_theme(dark.matches ? "dark" : "light");
    dark.addEventListener("change", theme);
    theme();
    this.view.draw(); // the first time takes seconds where it is done by software
    requestAnimationFrame(() => this.#draw());
  }

  /** A binary message of the server: float64 time_s, then a float32 a field, little endian. */
  take(data) {
    this.frames += 1;
    if (data.byteLength !== this.frame_bytes) return;
    this.#row = new Float32Array(data, 8);
  }

  #draw() {
    requestAnimationFrame(() => this.#draw());
    const begin_ms = performance.now();
    if (begin_ms < this.#rest_until_ms) return;
    if (this.#row) this.view.show(this.#row);
    this.#row = null;
    if (this.view.draw()) this.pictures += 1;
    const took_ms = performance.now() - begin_ms;
    if (took_ms > slow_ms) this.#rest_until_ms = begin_ms + 2 * took_ms;
  }

  #count() {
    this.fps = this.pictures - this.#counted;
    this.#counted = this.pictures;
    if (this.view) this.note.textContent = `${this.fps} pictures a second`;
  }

  #missing(why) {
    this.canvas.remove();
    this.note.remove();
    const line = document.createElement("p");
    line.textContent = why;
    this.holder.append(line);
  }
}
