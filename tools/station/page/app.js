// The page of a log: the robot in 3-D, its values beside it, and time. The live page (console/main.js) has the
// robot, its layers, its legend and its plots from the same modules; panels, commands and driving are its own.
import {add_layers, add_legend} from "layers";
import {RobotView, torque_colour} from "robot_view";
import {Footfalls} from "footfalls";
import {Plots, number_text} from "plots";
import {Timeline} from "timeline";
import {LogSource, index_of_fields, word_of} from "source";

const by_id = (id) => document.getElementById(id);

/** A bar for each joint: torque at the gear's output in its limits, with the bound of its error. */
class JointBars {
  constructor(container, layout, scene) {
    const index = index_of_fields(layout);
    this.rows = layout.joints.map((joint, i) => {
      const limit_Nm = scene?.joints[i].torque_limit_Nm ?? null;
      const row = document.createElement("div");
      row.className = "joint";
      row.innerHTML = "<span></span><div class='gauge'><i class='bound'></i><i class='value'></i></div><b></b>";
      row.firstChild.textContent = joint;
      container.append(row);
      const [bound, value] = row.querySelectorAll("i");
      return {limit_Nm, bound, value, text: row.lastChild,
              torque: index.get(`joints.${joint}.gear_output_torque_Nm`),
              error: index.get(`joints.${joint}.gear_output_torque_bound_Nm`)};
    });
    this.most_Nm = 1;
  }
  show(row) {
    for (const joint of this.rows) {
      const torque_Nm = row[joint.torque];
      const error_Nm = row[joint.error];
      const most_Nm = joint.limit_Nm ?? (this.most_Nm = Math.max(this.most_Nm, Math.abs(torque_Nm) || 0));
      const place = (Nm) => Math.max(0, Math.min(100, 50 + 50 * Nm / most_Nm));
      joint.text.textContent = Number.isFinite(torque_Nm) ?
        `${number_text(torque_Nm)}${Number.isFinite(error_Nm) ? ` ± ${number_text(error_Nm)}` : ""} Nm` : "-";
      joint.value.hidden = joint.bound.hidden = !Number.isFinite(torque_Nm);
      if (joint.value.hidden) continue;
      span(joint.value, Math.min(50, place(torque_Nm)), Math.max(50, place(torque_Nm)));
      span(joint.bound, place(torque_Nm - (error_Nm || 0)), place(torque_Nm + (error_Nm || 0)));
      joint.value.style.background = `rgb(${torque_colour(torque_Nm / most_Nm).join(",")})`;
    }
  }
}
function span(bar, from, to) {
  bar.style.left = `${from}%`;
  bar.style.width = `${to - from}%`;
}

export class App {
  constructor(config) {
    this.config = config;
    this.source = new LogSource(config, by_id("data").textContent);
    this.fields = index_of_fields(config.layout);
  }

  async open() {
    await this.source.open();
    by_id("title").textContent = this.config.title;
    this.show_notes();
    this.make_view();
    this.joints = new JointBars(by_id("joints"), this.config.layout, this.config.scene);
    this.footfalls = new Footfalls(by_id("footfalls"), this.source);
    this.plots = new Plots(by_id("plots"), by_id("plot-tools"), this.source, (time_s) => this.timeline.seek(time_s));
    this.badges = by_id("badges");
    this.timeline = new Timeline(by_id("timeline"), this.source, this.config, (time_s) => this.show(time_s));
    this.set_theme(matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
    by_id("theme").addEventListener("click", () => this.set_theme(this.theme === "dark" ? "light" : "dark"));
    const at = new URLSearchParams(location.hash.slice(1)).get("at");
    if (at !== null) this.timeline.seek(Number(at));
    if (this.view?.draw()) this.pictures = 1;
    requestAnimationFrame((now_ms) => this.frame(now_ms));
  }

  show_notes() {
    const list = by_id("notes").querySelector("ul");
    for (const text of this.config.notes) {
      const item = document.createElement("li");
      item.textContent = text;
      list.append(item);
    }
  }

  make_view() {
    const note = by_id("stage-note");
    const say = (text) => {
      note.textContent = text;
      note.hidden = false;
      by_id("view").hidden = true;
    };
    if (this.config.scene === null) return say(`${this.config.scene_missing} Plots and times are here all the same.`);
    try {
      this.view = new RobotView(by_id("view"), this.config.scene, this.config.layout);
    } catch (error) {
      return say("This browser has no WebGL, so that the robot cannot be drawn in 3-D; plots and times are here " +
                 `all the same. (${error.message})`);
    }
    add_layers(by_id("stage-tools"), this.view);
    add_legend(by_id("legend"), this.config.scene, this.has_truth());
  }

  has_truth() {
    return this.config.layout.legs.some(
      (leg) => this.source.series(this.fields.get(`legs.${leg}.true_contact_force_N.z`)) !== null);
  }

  set_theme(theme) {
    this.theme = theme;
    document.documentElement.dataset.theme = theme;
    this.view?.set_theme(theme);
    this.plots.set_theme(theme);
    this.footfalls.set_theme(theme);
    this.show(this.timeline.time_s);
  }

  show(time_s) {
    const row = this.source.row(time_s);
    this.view?.show(row);
    this.joints.show(row);
    this.footfalls.show(time_s);
    this.plots.show(time_s, row);
    this.show_badges(row);
  }

  show_badges(row) {
    const word = (name) => word_of(this.config.layout.fields[this.fields.get(name)], row[this.fields.get(name)]);
    const texts = [["motion", word("motion.state")], ["safety", word("safety.level")], ["trunk by", word("trunk.source")]];
    const text = texts.filter(([, value]) => value !== "").map(([name, value]) => `${name}: ${value}`).join("   ");
    if (this.badges.textContent !== text) this.badges.textContent = text;
    this.badges.dataset.safety = word("safety.level");
  }

  frame(now_ms) {
    this.timeline.tick(now_ms);
    if (this.view?.draw()) this.pictures = (this.pictures ?? 0) + 1;
    requestAnimationFrame((next_ms) => this.frame(next_ms));
  }
}

export async function start() {
  const app = new App(JSON.parse(by_id("config").textContent));
  window.sprung = app;  // to look inside from the browser's console, and for tests
  try {
    await app.open();
    performance.mark("sprung-ready");
    document.documentElement.dataset.ready = "yes";
  } catch (error) {
    const note = by_id("stage-note");
    note.textContent = `This page could not be opened: ${error.message}. A current Chromium, Firefox or Safari can.`;
    note.hidden = false;
    document.documentElement.dataset.ready = "failed";
    throw error;
  }
}
