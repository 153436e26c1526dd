// What of the robot's picture can be switched off, and what its colours mean; of a log's page and the live
// one.
import {torque_colour} from "robot_view";

const kLayers = [["ghost", "commanded pose"], ["forces", "foot forces"], ["cones", "friction cones"],
                 ["torques", "torque colours"], ["follow", "follow"]];

/** A switch for each layer. @param view robot_view.js's */
export function add_layers(tools, view) {
  for (const [layer, label] of kLayers) {
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = true;
    box.dataset.layer = layer;
    box.addEventListener("change", () => view.set_shown(layer, box.checked));
    const holder = document.createElement("label");
    holder.append(box, ` ${label}`);
    tools.append(holder);
  }
}

/** @param has_truth whether the simulation's forces are there */
export function add_legend(legend, {friction_coefficient, friction_source}, has_truth) {
  const stops = [-1, -0.5, 0, 0.5, 1].map((share) => `rgb(${torque_colour(share).join(",")})`).join(",");
  legend.innerHTML = "<span>−limit <i class='ramp'></i> +limit: torque at the gear</span>" +
    "<span><i class='dot estimated'></i>foot force, estimated</span>" +
    "<span class='truth'><i class='dot true'></i>simulation's truth</span>" +
    "<span><i class='dot slip'></i>outside its cone</span><span class='cone'></span>";
  legend.querySelector(".ramp").style.background = `linear-gradient(90deg, ${stops})`;
  legend.querySelector(".truth").hidden = !has_truth;
  const cone = legend.querySelector(".cone");
  cone.hidden = friction_coefficient === null;
  cone.textContent = `cone: friction ${friction_coefficient} (${friction_source})`;
}
