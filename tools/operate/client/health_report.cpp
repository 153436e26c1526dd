#include "tools/operate/client/health_report.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "drivers/canopen/emergency.h"
#include "drivers/canopen/nmt.h"
#include "lcmtypes/channels.h"
#include "signals/modes.h"
#include "tools/operate/client/motion_report.h"

namespace sprung {

using Json = nlohmann::ordered_json;

HealthListener::HealthListener(const RunInfo& info, const RobotConfig& robot)
    : node_({info.lcm_url, info.session, info.epoch_us, {}}) {
  const std::size_t nodes = robot.actuators.size() + robot.encoder_cards.size();
  node_.subscribe_message(channels::kBusState, CountLimits::exactly(robot.buses.size(), nodes), buses_);
  node_.subscribe_message(channels::kSafetyState, CountLimits::none(), safeties_);
  node_.start();
}

void HealthListener::take() {
  while (auto state = buses_.pop()) bus_ = std::move(*state);
  while (auto state = safeties_.pop()) safety_ = std::move(*state);
}

std::string node_name(const RobotConfig& robot, const sprung_msgs::node_health_t& node, std::size_t index) {
  const std::size_t card = index - robot.actuators.size();
  if (index < robot.actuators.size()) return robot.actuators[index].name;
  if (card < robot.encoder_cards.size()) return robot.encoder_cards[card].name;
  return "node " + std::to_string(node.node);
}

std::string recovery_text(const sprung_msgs::node_health_t& node) {
  const auto* text = reinterpret_cast<const char*>(node.recovery);
  return {text, std::find(text, text + sizeof node.recovery, '\0')};
}

namespace {

/// Before it limits, and when it does: 1 is as warm as the rated current makes it.
std::string winding_text(double share, bool first) {
  constexpr double kTold = 0.8;  // [design choice]
  if (!(share >= kTold)) return "";
  char text[80];
  std::snprintf(text, sizeof text, "%swinding at %.0f %% of its warmth%s", first ? "" : ", ", 100.0 * share,
                share >= 1.0 ? ": the rated current alone" : "");
  return text;
}

}  // namespace

std::string node_trouble(const sprung_msgs::node_health_t& node) {
  std::string text;
  const auto add = [&text](std::int64_t count, const std::string& what) {
    if (count != 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + what;
  };
  std::string emergency = "emergencies";
  if (node.last_emergency_code != 0) {
    char code[16];
    std::snprintf(code, sizeof code, "0x%04X ", static_cast<unsigned>(node.last_emergency_code));
    emergency += " (last " + std::string(code) +
                 canopen::emergency_text(static_cast<std::uint16_t>(node.last_emergency_code)) + ")";
  }
  add(node.emergencies, emergency);
  add(node.boot_ups, "unasked boot-ups");
  add(node.missing_samples, "samples missing");
  add(node.late_samples, "late");
  add(node.short_frames, "short");
  add(node.duplicate_samples, "double");
  add(node.implausible_samples, "implausible");
  add(node.heartbeat_losses, "heartbeat losses");
  add(node.sdo_failures, "failed SDO transfers");
  add(node.limited_joint_position, "cycles held at a joint's limit");
  add(node.limited_speed, "held at the speed limit");
  add(node.limited_rate, "set-points too fast");
  add(node.limited_power, "held at the power limit");
  add(node.limited_winding, "held for the winding");
  text += winding_text(node.winding_share, text.empty());
  add(node.limited_by_drive, "limited by the drive");
  if (!node.operational) text = std::string("not operational") + (text.empty() ? "" : ", ") + text;
  return text;
}

Json auxiliary_json(const RobotConfig& robot, const std::optional<sprung_msgs::auxiliary_state_t>& state) {
  if (!state) return nullptr;
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  Json out{{"temperatures_degC", Json::object()}, {"battery", nullptr}};
  for (std::size_t i = 0; i < state->measured_temperature_degC.size() && i < robot.actuators.size(); ++i) {
    if (robot.actuators[i].temperature.reading.index != 0)
      out["temperatures_degC"][robot.actuators[i].name] = number(state->measured_temperature_degC[i]);
  }
  if (robot.battery.bus < 0) return out;
  out["battery"] = {{"voltage_V", number(state->battery_voltage_V)},
                    {"charge_share", number(state->battery_charge_share)},
                    {"temperature_degC", number(state->battery_temperature_degC)},
                    {"low", state->battery_charge_share < robot.battery.min_charge_share}};
  return out;
}

std::vector<std::string> auxiliary_lines(const Json& auxiliary) {
  std::vector<std::string> lines;
  if (auxiliary.is_null()) return lines;
  const auto text = [](const Json& value, double scale, const char* unit) {
    char buffer[32];
    if (!value.is_number()) return std::string("?") + unit;
    std::snprintf(buffer, sizeof buffer, "%.3g%s", scale * value.get<double>(), unit);
    return std::string(buffer);
  };
  const Json& battery = auxiliary["battery"];
  if (!battery.is_null())
    lines.push_back("battery " + text(battery["charge_share"], 100.0, " %, ") +
                    text(battery["voltage_V"], 1.0, " V, ") +
                    text(battery["temperature_degC"], 1.0, " degC") +
                    (battery["low"].get<bool>() ? "; LOW: let the robot sit, then charge" : ""));
  std::string drives;
  for (const auto& [name, value] : auxiliary["temperatures_degC"].items())
    drives += (drives.empty() ? "" : ", ") + name + " " + text(value, 1.0, " degC");
  if (!drives.empty()) lines.push_back("drives  " + drives);
  return lines;
}

Json buses_json(const RobotConfig& robot, const sprung_msgs::bus_state_t& state) {
  Json out = Json::array();
  for (std::size_t i = 0; i < state.buses.size() && i < robot.buses.size(); ++i) {
    const sprung_msgs::bus_health_t& bus = state.buses[i];
    out.push_back({{"name", robot.buses[i].name},
                   {"condition", name(static_cast<BusCondition>(bus.condition))},
                   {"load_share", bus.load_share},
                   {"sent", bus.sent},
                   {"received", bus.received},
                   {"send_failed", bus.send_failed},
                   {"no_buffers", bus.no_buffers},
                   {"dropped", bus.dropped},
                   {"malformed", bus.malformed},
                   {"unexpected", bus.unexpected},
                   {"error_frames", bus.error_frames},
                   {"bus_offs", bus.bus_offs},
                   {"restarts", bus.restarts}});
  }
  return out;
}

Json nodes_json(const RobotConfig& robot, const sprung_msgs::bus_state_t& state) {
  Json out = Json::array();
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    const sprung_msgs::node_health_t& node = state.nodes[i];
    const bool known_bus = node.bus >= 0 && node.bus < static_cast<int>(robot.buses.size());
    out.push_back(
        {{"name", node_name(robot, node, i)},
         {"bus", known_bus ? Json(robot.buses[node.bus].name) : Json(nullptr)},
         {"node", node.node},
         {"operational", node.operational != 0},
         {"nmt_state",
          node.nmt_state < 0 ? "unknown" : canopen::nmt_text(static_cast<canopen::NmtState>(node.nmt_state))},
         {"last_emergency_code", node.last_emergency_code},
         {"error_register", node.error_register},
         {"emergencies", node.emergencies},
         {"boot_ups", node.boot_ups},
         {"missing_samples", node.missing_samples},
         {"late_samples", node.late_samples},
         {"short_frames", node.short_frames},
         {"duplicate_samples", node.duplicate_samples},
         {"implausible_samples", node.implausible_samples},
         {"heartbeat_losses", node.heartbeat_losses},
         {"sdo_failures", node.sdo_failures},
         {"limited_joint_position", node.limited_joint_position},
         {"limited_speed", node.limited_speed},
         {"limited_rate", node.limited_rate},
         {"limited_power", node.limited_power},
         {"limited_winding", node.limited_winding},
         {"limited_by_drive", node.limited_by_drive},
         {"winding_share", node.winding_share},
         {"reference_source", name(static_cast<ReferenceSource>(node.reference_source))},
         {"reference_offset_rad",
          std::isfinite(node.reference_offset_rad) ? Json(node.reference_offset_rad) : Json(nullptr)},
         {"trouble", node_trouble(node)},
         {"recovery", recovery_text(node)}});
  }
  return out;
}

namespace {

/// What may be looked at before it is cleared.
const char* remedy(SafetyCause cause) {
  switch (cause) {
    case SafetyCause::kDriveFault:
    case SafetyCause::kDriveSilent:
      return "look at the drive's supply, cable and emergency code";
    case SafetyCause::kDriveRefused:
      return "mend what the detail names: drive or robot.yaml (sprung drive check)";
    case SafetyCause::kBusLost:
      return "look at the bus: cable, termination, interface (sprung can dump)";
    case SafetyCause::kOverruns:
      return "find what keeps the processor busy (sprung doctor)";
    case SafetyCause::kEmergencyStop:
      return "make sure that the robot may move again, release the button";
    case SafetyCause::kDuplicateNode:
    case SafetyCause::kForeignMaster:
      return "take the other device off the bus";
    case SafetyCause::kJointLimit:
      return "bring the joint back within its limits by hand";
    case SafetyCause::kWinding:
      return "let the motor cool down";
    case SafetyCause::kSupply:
      return "look at battery and supply";
    default:
      return "";
  }
}

}  // namespace

std::string safety_advice(const sprung_msgs::safety_state_t& safety) {
  const auto cause = static_cast<SafetyCause>(safety.cause);
  if (safety.latched) {
    const std::string first = remedy(cause);
    return first + (first.empty() ? "" : ", then ") + "clear, then stand";
  }
  if (safety.detail.find("sprung home") != std::string::npos) return "home, then stand";
  if (cause == SafetyCause::kNone && !safety.detail.empty()) return "it is over by itself; clear forgets it";
  return remedy(cause);
}

Json safety_json(const std::optional<sprung_msgs::safety_state_t>& safety, double age_s) {
  if (!safety) return {{"state", "unknown"}, {"cause", "the bridge says nothing"}};
  return {{"state", safety->level_name},
          {"cause", safety->cause_name},
          {"detail", safety->detail},
          {"latched", safety->latched},
          {"next", safety_advice(*safety)},
          {"overruns", safety->overruns},
          {"missed_cycles", safety->missed_cycles},
          {"commands_refused", safety->commands_refused},
          {"age_s", age_s},
          {"stale", age_s > kStale_s}};
}

std::string safety_text(const Json& safety) {
  std::string text = "safety  " + safety["state"].get<std::string>() + ", cause " +
                     safety["cause"].get<std::string>();
  const std::string detail = safety.value("detail", "");
  if (!detail.empty()) text += ": " + detail;
  text += stale_text(safety, "the bridge");
  const bool over = safety["cause"] == name(SafetyCause::kNone) && !detail.empty();
  if (over) text += "\n        over by itself; sprung clear forgets it";
  if (safety.value("latched", 0) != 0) text += "\n        next: sprung clear, then sprung stand";
  return text;
}

}  // namespace sprung
