// Time: play, speed, loop, a slider over the phases of the motion, events to jump to.
const kSpeeds = [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10];
/** Fills of phases; each has its name on it as well where there is room. */
const kFills = ["#9ecae1", "#fdd0a2", "#c7e9c0", "#dadaeb", "#fee391", "#d9d9d9", "#b2e2e2", "#f4cae4"];

function element(tag, attributes, ...children) {
  const one = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) one.setAttribute(name, value);
  one.append(...children);
  return one;
}

export class Timeline {
  /** @param on_time (time_s) called when the time shown is another */
  constructor(container, source, config, on_time) {
    this.source = source;
    this.on_time = on_time;
    [this.first_s, this.last_s] = source.range();
    this.time_s = this.first_s;
    this.playing = false;
    this.speed = 1;
    this.loop = false;
    this.play_button = element("button", {type: "button", id: "play", title: "space"}, "Play");
    this.play_button.addEventListener("click", () => this.set_playing(!this.playing));
    this.speed_select = element("select", {id: "speed", "aria-label": "Speed"});
    for (const speed of kSpeeds) this.speed_select.add(new Option(`${speed} ×`, String(speed), speed === 1, speed === 1));
    this.speed_select.addEventListener("change", () => { this.speed = Number(this.speed_select.value); });
    const loop = element("input", {type: "checkbox", id: "loop"});
    loop.addEventListener("change", () => { this.loop = loop.checked; });
    this.clock = element("output", {id: "clock", for: "slider"});
    this.phase = element("span", {id: "phase"});
    container.append(element("div", {class: "controls"}, this.play_button, this.speed_select,
                             element("label", {}, loop, " loop"), this.event_list(config.events), this.clock, this.phase),
                     this.bar(config));
    document.addEventListener("keydown", (event) => this.key(event));
    this.seek(this.first_s);
  }

  bar({events, phases}) {
    this.phases = phases;
    this.slider = element("input", {type: "range", id: "slider", min: "0", max: "10000", step: "1", value: "0",
                                    "aria-label": "Time"});
    this.slider.addEventListener("input", () => this.seek(this.first_s + (this.last_s - this.first_s) * this.slider.value / 10000));
    const names = [...new Set(phases.map((phase) => phase.name))];
    const strip = element("div", {class: "phases", "aria-hidden": "true"});
    for (const phase of phases) {
      const part = element("span", {title: phase.name}, phase.name);
      part.style.left = `${this.share(phase.from_s)}%`;
      part.style.width = `${this.share(phase.to_s) - this.share(phase.from_s)}%`;
      part.style.background = kFills[names.indexOf(phase.name) % kFills.length];
      strip.append(part);
    }
    for (const event of events.filter(({kind}) => kind === "safety")) {
      const mark = element("i", {class: event.trip ? "trip" : "mark", title: event.text});
      mark.style.left = `${this.share(event.time_s)}%`;
      strip.append(mark);
    }
    return element("div", {class: "bar"}, strip, this.slider);
  }

  share(time_s) {
    return 100 * (time_s - this.first_s) / Math.max(1e-9, this.last_s - this.first_s);
  }

  event_list(events) {
    this.events = events;
    const list = element("select", {id: "events", "aria-label": "Jump to an event"});
    list.add(new Option(`${events.length} events`, ""));
    events.forEach((event, i) => list.add(new Option(`${event.time_s.toFixed(3)} s  ${event.trip ? "STOP " : ""}${event.text}`, String(i))));
    list.addEventListener("change", () => {
      if (list.value === "") return;
      this.set_playing(false);
      this.seek(this.events[Number(list.value)].time_s);
    });
    return list;
  }

  /** The phase at a time, or undefined. */
  phase_at(time_s) {
    return this.phases.findLast(({from_s}) => from_s <= time_s + 1e-9);
  }

  seek(time_s) {
    this.time_s = Math.min(this.last_s, Math.max(this.first_s, time_s));
    this.slider.value = String(Math.round(100 * this.share(this.time_s)));
    const phase = this.phase_at(this.time_s)?.name ?? "";
    this.slider.setAttribute("aria-valuetext", `${this.time_s.toFixed(2)} seconds, ${phase}`);
    this.clock.textContent = `${this.time_s.toFixed(3)} s of ${this.last_s.toFixed(3)} s`;
    this.phase.textContent = phase;
    this.on_time(this.time_s);
  }

  set_playing(on) {
    this.playing = on;
    this.play_button.textContent = on ? "Pause" : "Play";
    if (on && this.time_s >= this.last_s) this.seek(this.first_s);
    this.last_frame_ms = null;
  }

  /** Called at every picture of the screen. */
  tick(now_ms) {
    if (!this.playing) return;
    const step_s = this.last_frame_ms === null ? 0 : (now_ms - this.last_frame_ms) / 1000 * this.speed;
    this.last_frame_ms = now_ms;
    if (this.time_s + step_s < this.last_s) return this.seek(this.time_s + step_s);
    if (this.loop) return this.seek(this.first_s);
    this.seek(this.last_s);
    this.set_playing(false);
  }

  key(event) {
    if (event.target.closest("input, select, button, summary, textarea")) return;
    const step_s = event.shiftKey ? 0.1 : 0.01;
    if (event.key === " ") this.set_playing(!this.playing);
    else if (event.key === "ArrowRight") this.seek(this.time_s + step_s);
    else if (event.key === "ArrowLeft") this.seek(this.time_s - step_s);
    else if (event.key === "Home") this.seek(this.first_s);
    else if (event.key === "End") this.seek(this.last_s);
    else return;
    event.preventDefault();
  }
}
