// The live page: what the server says goes into panels, what the operator does goes to the server.
import { showCommands } from "./commands.js";
import { Driving } from "./driving.js";
import { Link } from "./link.js";
import { mountLivePlots } from "./live_plots.js";
import { Panels } from "./panels.js";
import { Parameters } from "./parameters.js";
import { LiveView } from "./view.js";

const hold_ms = 100;
const most_news = 40;
const byId = (id) => document.getElementById(id);
const link = new Link(new URL("live", location.href).href.replace(/^http/, "ws"));
let panels = null;
let parameters = null;
let state = null;
let drives = false;
const view = new LiveView(byId("view"));
const plots = mountLivePlots(link, view);

function show(id, value, name) {
  if (byId(id).textContent !== value) byId(id).textContent = value;
  if (name !== undefined && byId(id).className !== name) byId(id).className = name;
}

function news(line, bad) {
  const item = document.createElement("li");
  item.textContent = `${new Date().toLocaleTimeString()}  ${line}`;
  if (bad) item.className = "bad";
  byId("news").prepend(item);
  while (byId("news").children.length > most_news) byId("news").lastChild.remove();
}

function banner(text) {
  byId("banner").hidden = text === "";
  show("banner", text);
}

/** Not modal: a modal dialog would lie over the emergency stop. All but the page's head is inert meanwhile. */
function ask(question) {
  const dialog = byId("confirm"), main = document.querySelector("main"), before = document.activeElement;
  show("confirm-text", question);
  dialog.returnValue = "no";
  main.inert = true;
  dialog.show();
  dialog.querySelector("button[value=no]").focus();
  return new Promise((resolve) => dialog.addEventListener("close", () => {
    main.inert = false;
    before?.focus();
    resolve(dialog.returnValue === "yes");
  }, { once: true }));
}

function showRole(driver, why) {
  drives = driver === link.page;
  show("role", drives ? "you drive" : driver < 0 ? "nobody drives" : "another page drives", drives ? "badge good" : "badge");
  byId("role").title = why;
  byId("take-over").hidden = drives;
  for (const button of document.querySelectorAll("#commands button, #parameters button, #driving select, #enable")) button.disabled = !drives;
}

function showSession(session) {
  showRole(session.driver, session.driver_why);
  const { state: sticks, why, gait, speed } = session.sticks;
  const [forward, left, turning] = speed.map((value) => value.toFixed(2));
  const lines = { locked: `locked: ${why}`, ready: "ready", driving: `${gait}: ${forward} m/s forward, ${left} left, ${turning} rad/s` };
  show("sticks", byId("source").value === "" ? "choose a keyboard or gamepad" : lines[sticks]);
  if (session.estop.state === "pressed") show("estop-state", `said for ${session.estop.for_ms.toFixed(0)} ms`);
}

const on = (type, handle) => link.addEventListener(type, (event) => handle(event.detail));
on("robot", (robot) => {
  panels = new Panels(robot);
  document.title = `${robot.robot} – sprung console`;
  byId("gait").replaceChildren(...robot.gaits.map((gait) => new Option(gait.name, gait.index)));
  byId("gait").selectedIndex = robot.gaits.reduce((best, gait, i) => (gait.fastest[0] > robot.gaits[best].fastest[0] ? i : best), 0);
  byId("driving").hidden = robot.gaits.length === 0;
  byId("enable").hidden = !robot.maintenance;
});
on("hello", (hello) => {
  const own = (command) => command.name !== "set_parameter"; // that one has a table of its own
  showCommands(byId("commands"), hello.commands.filter(own), link, ask);
  parameters = new Parameters(byId("parameters"), hello.parameters, link);
});
on("parameters", ({ values }) => parameters?.show(values));
on("role", ({ driver, why }) => {
  showRole(driver, why);
  news(`${drives ? "this page drives" : driver < 0 ? "nobody drives" : "another page drives"}: ${why}`, false);
});
on("state", (message) => {
  state = message;
  panels?.update(message);
  showSession(message.session);
});
on("frame", (data) => view.take(data));
on("reply", ({ command, outcome, reason, cycle }) => {
  const bad = !["accepted", "queued", "done"].includes(outcome);
  news(`${command}: ${outcome}${reason ? `: ${reason}` : ""}${cycle >= 0 ? ` (cycle ${cycle})` : ""}`, bad);
});
on("error", ({ text }) => news(text, true));
on("end", ({ text }) => banner(`${text}. Start it (sprung up), then sprung console, and open the address that it prints.`));
on("estop", ({ state: estop, for_ms }) => {
  byId("confirm").close("no"); // nothing that was about to be said yes to counts any more
  const words = { asked: "asked for", pressed: "said to the robot", confirmed: `no drive has power (after ${for_ms?.toFixed(0)} ms)` };
  show("estop-state", `EMERGENCY STOP ${words[estop]}`);
});

byId("estop").onclick = () => link.estop();
byId("take-over").onclick = () => link.send({ type: "take_over" });
// In front of every other use of the space bar, whatever has the focus.
addEventListener("keydown", (event) => {
  if (event.key !== " ") return;
  event.preventDefault();
  event.stopImmediatePropagation();
  if (!event.repeat) link.estop();
}, { capture: true });
byId("confirm").onkeydown = (event) => event.key === "Escape" && byId("confirm").close("no");
addEventListener("keyup", (event) => event.key === " " && event.preventDefault(), { capture: true });

let enabling = false;
const enable = (held) => {
  enabling = held;
  link.send({ type: "enable", held });
};
byId("enable").onpointerdown = () => enable(true);
for (const type of ["pointerup", "pointercancel", "pointerleave"]) byId("enable").addEventListener(type, () => enabling && enable(false));

/** What the link to a robot on another computer says of itself: who we are there, who drives, or that it is lost. "": the robot is here. */
const linkSays = () => state?.processes.find(({ name }) => name === "operator-link")?.detail ?? "";

function renew() {
  const here = document.visibilityState === "visible";
  if (drives && state?.session.held) link.send({ type: "hold", held: here });
  if (drives && enabling) enable(here);
}
document.addEventListener("visibilitychange", renew); // timers of a hidden page go once a second
setInterval(() => {
  renew();
  const says = linkSays(), cut = says.includes("LOST") ? says : "", stale = link.stale || cut !== "";
  byId("via").hidden = says === "" || cut !== "";
  show("via", says);
  show("link", !link.open ? "no connection" : cut ? "link lost" : stale ? "nothing heard" : "live", `badge ${stale ? "bad" : "good"}`);
  const why = link.stale ? "No connection to the console: what is shown is old. A motion that this page held has ended in a stand." :
    cut && `${cut[0].toUpperCase()}${cut.slice(1)}. What is shown is old.`;
  if (!byId("banner").textContent.includes("Start it")) banner(why);
  document.body.classList.toggle("stale", stale);
}, hold_ms);

new Driving(link, { source: byId("source"), gait: byId("gait"), estop: () => link.estop() });
view.open().catch((error) => news(`the 3-D view: ${error.message}`, true)).finally(() => { link.ready = true; });
// For tests and the browser's own console.
window.sprung = { link, view, get state() { return state; }, get plots() { return plots(); } };
