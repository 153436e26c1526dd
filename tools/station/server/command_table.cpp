#include "tools/station/server/command_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "planner/comply_request.h"
#include "planner/gait/walk.h"
#include "planner/joint_limits.h"
#include "planner/requests.h"
#include "robots/parameters.h"
#include "signals/angles.h"
#include "tools/operate/client/gait_choice.h"

namespace sprung::station {
namespace {

using Json = nlohmann::json;

constexpr double kDegrees_per_rad = 180.0 / kPi;
constexpr const char* kAll = "all";
constexpr const char* kFitting = "fitting";  // of gaits: the one that goes so fast
constexpr double kGentleShare = 0.1;         // of a joint's speed limit, as `sprung move` has it
constexpr double kGentleRise_s = 0.25;

CommandParameter number(std::string name, std::string label, std::string unit, double low, double high,
                        double step, double usual = kNaN) {
  return {std::move(name), std::move(label), std::move(unit), low, high, step, usual, {}};
}

CommandParameter choice(std::string name, std::string label, std::vector<std::string> choices) {
  return {std::move(name), std::move(label), "", 0.0, 0.0, 0.0, kNaN, std::move(choices)};
}

/// All names of an enumeration, `first` in front.
template <class E>
std::vector<std::string> names_with(E first) {
  std::vector<std::string> names = names_of<E>();
  std::rotate(names.begin(), std::find(names.begin(), names.end(), name(first)), names.end());
  return names;
}

std::vector<std::string> joint_names(const RobotConfig& robot) {
  std::vector<std::string> names;
  for (const JointConfig& joint : robot.joints) names.push_back(joint.name);
  return names;
}

std::vector<std::string> with_first(const char* first, std::vector<std::string> names) {
  names.insert(names.begin(), first);
  return names;
}

OperatorForm simple(OperatorKind kind, const char* title, const char* help) {
  return {name(kind), title, help, kind, false, "", {}};
}

OperatorForm jump_form(const PresetConfig& preset) {
  const double usual_mm = 1e3 * preset.jump_curve.height_m;
  return {"jump",
          "Jump",
          "Jumps on the spot, or forward where its rail is free. It must stand.",
          OperatorKind::kJump,
          false,
          "",
          {number("height_mm", "height", "mm", 0.0, std::ceil(usual_mm * 0.04) * 50.0, 10.0,
                  std::round(usual_mm)),
           number("forward_mm", "forward", "mm", -500.0, 500.0, 10.0, 0.0),
           number("count", "how many", "", 1.0, kMostJumps, 1.0, 1.0),
           choice("mode", "control", names_with(JumpMode::kHybrid))}};
}

OperatorForm comply_form() {
  return {"comply",
          "Comply",
          "Each foot on a virtual spring, while this page is open. Empty: the preset's.",
          OperatorKind::kComply,
          true,
          "",
          {number("stiffness_x_N_m", "stiffness x", "N/m", 0.0, kStiffest_N_m, 100.0),
           number("stiffness_z_N_m", "stiffness z", "N/m", 0.0, kStiffest_N_m, 100.0),
           number("damping_x_N_s_m", "damping x", "N s/m", 0.0, kMostDamping_N_s_m, 5.0),
           number("damping_z_N_s_m", "damping z", "N s/m", 0.0, kMostDamping_N_s_m, 5.0),
           number("friction_compensation", "friction compensated", "share", 0.0, 1.0, 0.05)}};
}

OperatorForm land_form() {
  return {"land",
          "Land",
          "Catches a fall from rest that begins now. It must stand, in the air.",
          OperatorKind::kLand,
          false,
          "",
          {number("touchdown_in_s", "touchdown in", "s", kShortestFall_s, kLongestFall_s, 0.01, 0.25),
           choice("mode", "control", names_with(JumpMode::kHybrid))}};
}

OperatorForm walk_form(const RobotConfig& robot, const PresetConfig& preset) {
  std::vector<std::string> gaits{kFitting};
  Vec3 fastest{};
  double backward_m_s = 0.0;
  const double stand_m = preset.stand_length_m;
  for (const GaitConfig& gait : robot.gaits) {
    gaits.push_back(gait.name);
    backward_m_s = std::max(backward_m_s, gait.fastest_backward_m_s);
    fastest = {std::max(fastest[0], gait.fastest_forward_m_s),
               std::max(fastest[1], gait.fastest_sideways_m_s),
               std::max(fastest[2], gait.fastest_turning_rad_s)};
  }
  return {"walk",
          "Walk",
          "Walks while this page is open; once more: another speed or gait. It must stand.",
          OperatorKind::kWalk,
          true,
          "",
          {number("forward_m_s", "forward", "m/s", -backward_m_s, fastest[0], 0.01, 0.2),
           number("left_m_s", "to the left", "m/s", -fastest[1], fastest[1], 0.01, 0.0),
           number("turning_rad_s", "turning left", "rad/s", -fastest[2], fastest[2], 0.01, 0.0),
           number("height_mm", "hips over feet", "mm", std::ceil(1e3 * Walk::kLowestShare * stand_m),
                  std::floor(1e3 * Walk::kHighestShare * stand_m), 5.0),
           number("width_mm", "feet further out", "mm", 1e3 * Walk::kNarrowest_m, 1e3 * Walk::kWidest_m, 5.0),
           choice("gait", "gait", std::move(gaits)),
           choice("control", "control", names_with(GaitControl::kAdaptive))}};
}

OperatorForm home_form(const RobotConfig& robot) {
  std::vector<std::string> names;
  for (const ActuatorConfig& actuator : robot.actuators) names.push_back(actuator.name);
  return {"home",
          "Home",
          "Finds the zero of actuators that have no power and stand still.",
          OperatorKind::kHome,
          false,
          "Where a zero comes from the jig, the robot must stand in it, or its zero will be wrong.",
          {choice("actuator", "actuator", with_first(kAll, std::move(names))),
           choice("from", "from", names_with(ReferenceSource::kConfigured))}};
}

OperatorForm move_form(const RobotConfig& robot) {
  double low = 0.0, high = 0.0, fastest = 0.0, quickest = 0.0;
  for (const JointLimits& limits : joint_limits(robot)) {
    low = std::min(low, limits.position_min_rad * kDegrees_per_rad);
    high = std::max(high, limits.position_max_rad * kDegrees_per_rad);
    fastest = std::max(fastest, limits.speed_rad_s * kDegrees_per_rad);
    quickest = std::max(quickest, limits.acceleration_rad_s2 * kDegrees_per_rad);
  }
  return {"move",
          "Move a joint",
          "Moves one joint and holds all others, drives on; sit lets go. Say to or by.",
          OperatorKind::kMoveJoint,
          false,
          "",
          {choice("joint", "joint", joint_names(robot)), number("by_deg", "by", "deg", -180.0, 180.0, 1.0),
           number("to_deg", "to", "deg", std::floor(low), std::ceil(high), 1.0),
           number("speed_deg_s", "speed", "deg/s", 0.1, std::floor(fastest), 1.0),
           number("acceleration_deg_s2", "acceleration", "deg/s²", 0.1, std::floor(quickest), 1.0)}};
}

OperatorForm parameter_form(const std::vector<Parameter>& parameters) {
  constexpr double kAny = 1e9;  // each has a range of its own
  std::vector<std::string> names;
  names.reserve(parameters.size());
  for (const Parameter& one : parameters) names.push_back(one.name);
  return {
      "set_parameter",
      "Set parameter",
      "Another value for a number of robot.yaml, reached in a second.",
      OperatorKind::kSetParameter,
      false,
      "",
      {choice("parameter", "parameter", std::move(names)), number("value", "value", "", -kAny, kAny, 0.0)}};
}

/// The parameters of a request, checked against its form.
class Filled {
 public:
  Filled(const OperatorForm& form, const Json& parameters) : form_(form), parameters_(parameters) {
    if (!parameters.is_object()) throw std::invalid_argument("parameters must be an object");
    for (const auto& [key, value] : parameters.items()) check(key, value);
  }

  /// NaN where it is left out and has no usual value.
  double number(const char* name) const {
    const auto found = parameters_.find(name);
    return found == parameters_.end() || found->is_null() ? parameter(name).usual : found->get<double>();
  }
  std::string word(const char* name) const {
    const auto found = parameters_.find(name);
    return found == parameters_.end() ? parameter(name).choices.front() : found->get<std::string>();
  }

 private:
  const CommandParameter& parameter(const std::string& name) const {
    for (const CommandParameter& each : form_.parameters)
      if (each.name == name) return each;
    throw std::invalid_argument(form_.name + " has no parameter '" + name.substr(0, 40) + "'");
  }
  void check(const std::string& key, const Json& value) const {
    const CommandParameter& wanted = parameter(key);
    if (!wanted.choices.empty()) return check_word(wanted, value);
    if (value.is_null() && std::isnan(wanted.usual)) return;
    if (!value.is_number()) throw std::invalid_argument(wanted.label + " must be a number");
    const double number = value.get<double>();
    if (number >= wanted.low && number <= wanted.high) return;
    char text[160];
    std::snprintf(text, sizeof text, "%s must be %g to %g %s, not %g", wanted.label.c_str(), wanted.low,
                  wanted.high, wanted.unit.c_str(), number);
    throw std::invalid_argument(text);
  }
  static void check_word(const CommandParameter& wanted, const Json& value) {
    const auto& choices = wanted.choices;
    if (value.is_string() &&
        std::find(choices.begin(), choices.end(), value.get<std::string>()) != choices.end())
      return;
    std::string text = wanted.label + " must be one of";
    for (const std::string& each : choices) text += " " + each;
    throw std::invalid_argument(text);
  }

  const OperatorForm& form_;
  const Json& parameters_;
};

void fill_comply(const Filled& filled, OperatorCommand& command) {
  command.stiffness_N_m = {filled.number("stiffness_x_N_m"), kNaN, filled.number("stiffness_z_N_m")};
  command.damping_N_s_m = {filled.number("damping_x_N_s_m"), kNaN, filled.number("damping_z_N_s_m")};
  command.friction_compensation = filled.number("friction_compensation");
}

void fill_jump(const Filled& filled, OperatorCommand& command) {
  command.jump_height_m = 1e-3 * filled.number("height_mm");
  command.jump_forward_m = 1e-3 * filled.number("forward_mm");
  const double count = filled.number("count");
  if (count != std::floor(count)) throw std::invalid_argument("how many must be a whole number");
  command.jump_count = static_cast<int>(count);
  command.jump_mode = value_named<JumpMode>(filled.word("mode")).value();
}

void fill_walk(const Filled& filled, const RobotConfig& robot, const RobotNow& now,
               OperatorCommand& command) {
  GaitWish wish;
  if (filled.word("gait") != kFitting) wish.gait = filled.word("gait");
  wish.forward_m_s = filled.number("forward_m_s");
  wish.left_m_s = filled.number("left_m_s");
  wish.turning_rad_s = filled.number("turning_rad_s");
  const GaitChoice chosen = choose_gait(robot, wish, wish.gait.empty() ? now.walking_in : -1);
  command.gait = chosen.gait;
  command.walk_speed = chosen.speed;
  command.body_height_m = 1e-3 * filled.number("height_mm");
  command.stance_width_m = 1e-3 * filled.number("width_mm");
  command.gait_control = value_named<GaitControl>(filled.word("control")).value();
}

int index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

void fill_move(const Filled& filled, const RobotConfig& robot, const RobotNow& now,
               OperatorCommand& command) {
  const double to_deg = filled.number("to_deg"), by_deg = filled.number("by_deg");
  if (std::isnan(to_deg) == std::isnan(by_deg)) throw std::invalid_argument("say either to or by");
  command.joint = index_of(joint_names(robot), filled.word("joint"));
  const auto joint = static_cast<std::size_t>(command.joint);
  if (std::isnan(to_deg) && joint >= now.joint_positions_rad.size())
    throw std::invalid_argument("nobody says where the joint is now");
  command.joint_target_rad = std::isnan(to_deg) ? now.joint_positions_rad[joint] + by_deg / kDegrees_per_rad
                                                : to_deg / kDegrees_per_rad;
  const double asked_deg_s = filled.number("speed_deg_s");
  command.joint_speed_rad_s = std::isnan(asked_deg_s) ? kGentleShare * joint_limits(robot)[joint].speed_rad_s
                                                      : asked_deg_s / kDegrees_per_rad;
  const double rise_deg_s2 = filled.number("acceleration_deg_s2");
  command.joint_acceleration_rad_s2 = std::isnan(rise_deg_s2) ? command.joint_speed_rad_s / kGentleRise_s
                                                              : rise_deg_s2 / kDegrees_per_rad;
}

void fill_home(const Filled& filled, OperatorCommand& command, const OperatorForm& form) {
  command.actuator = index_of(form.parameters.front().choices, filled.word("actuator")) - 1;  // "all": -1
  command.reference_source = value_named<ReferenceSource>(filled.word("from")).value();
}

void fill_parameter(const Filled& filled, OperatorCommand& command) {
  command.parameter = parameter_id(filled.word("parameter"));
  command.parameter_value = filled.number("value");
  if (std::isnan(command.parameter_value)) throw std::invalid_argument("value is missing");
}

}  // namespace

std::vector<OperatorForm> operator_forms(const RobotConfig& robot, const std::string& preset) {
  std::vector<OperatorForm> forms;
  if (robot.has_feet()) {
    forms.push_back(simple(OperatorKind::kStand, "Stand", "Switches the drives on and rises to the stand."));
    if (robot.preset(preset).jumps()) forms.push_back(jump_form(robot.preset(preset)));
    if (!robot.gaits.empty()) forms.push_back(walk_form(robot, robot.preset(preset)));
    forms.push_back(comply_form());
    if (robot.preset(preset).jumps()) forms.push_back(land_form());
    forms.push_back(simple(OperatorKind::kStop, "Stop", "Finishes the phase that runs, then stands."));
  }
  const std::vector<Parameter> parameters = parameters_of(robot, robot.preset(preset));
  if (!parameters.empty()) forms.push_back(parameter_form(parameters));
  forms.push_back(simple(OperatorKind::kSit, "Sit", "Lowers the body, then switches the drives off."));
  forms.push_back(move_form(robot));
  forms.push_back(home_form(robot));
  forms.push_back(simple(OperatorKind::kClear, "Clear",
                         "Brings the robot back from a latched cause; torque stays off until stand."));
  return forms;
}

nlohmann::ordered_json forms_json(const std::vector<OperatorForm>& forms) {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const OperatorForm& form : forms) {
    nlohmann::ordered_json parameters = nlohmann::ordered_json::array();
    for (const CommandParameter& each : form.parameters) {
      nlohmann::ordered_json row{{"name", each.name}, {"label", each.label}, {"unit", each.unit}};
      if (!each.choices.empty()) {
        row["choices"] = each.choices;
      } else {
        row["low"] = each.low;
        row["high"] = each.high;
        row["step"] = each.step;
        row["usual"] = std::isnan(each.usual) ? nlohmann::ordered_json(nullptr)
                                              : nlohmann::ordered_json(each.usual);
      }
      parameters.push_back(std::move(row));
    }
    out.push_back({{"name", form.name},
                   {"title", form.title},
                   {"help", form.help},
                   {"held", form.held},
                   {"confirm", form.confirm},
                   {"parameters", std::move(parameters)}});
  }
  return out;
}

const OperatorForm& form_named(const std::vector<OperatorForm>& forms, const std::string& name) {
  for (const OperatorForm& form : forms)
    if (form.name == name) return form;
  std::string text = "no command '" + name.substr(0, 40) + "'; there are:";
  for (const OperatorForm& form : forms) text += " " + form.name;
  throw std::invalid_argument(text);
}

OperatorCommand command_of(const OperatorForm& form, const RobotConfig& robot, const RobotNow& now,
                           const Json& parameters) {
  const Filled filled(form, parameters);
  OperatorCommand command;
  command.kind = form.kind;
  if (form.kind == OperatorKind::kJump) fill_jump(filled, command);
  if (form.kind == OperatorKind::kComply) fill_comply(filled, command);
  if (form.kind == OperatorKind::kWalk) fill_walk(filled, robot, now, command);
  if (form.kind == OperatorKind::kMoveJoint) fill_move(filled, robot, now, command);
  if (form.kind == OperatorKind::kSetParameter) fill_parameter(filled, command);
  if (form.kind == OperatorKind::kHome) fill_home(filled, command, form);
  if (form.kind == OperatorKind::kLand) {
    command.touchdown_in_s = filled.number("touchdown_in_s");
    command.jump_mode = value_named<JumpMode>(filled.word("mode")).value();
  }
  return command;
}

}  // namespace sprung::station
