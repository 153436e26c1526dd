#pragma once
/// Every command that an operator has, with its parameters, units and ranges: what a page makes its forms
/// from, and what turns a filled form into an OPERATOR_COMMAND. Pure.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/operator.h"

namespace sprung::station {

/// A number with a unit and a range, or one of several words. A number that is left out is NaN in the
/// command: the preset's.
struct CommandParameter {
  std::string name;   ///< key in a request: "height_mm"
  std::string label;  ///< for people
  std::string unit;
  double low = 0.0;
  double high = 0.0;
  double step = 0.0;
  double usual = kNaN;               ///< NaN: may stay empty
  std::vector<std::string> choices;  ///< not empty: a word; the first is the usual one
};

/// What a command becomes may depend on the robot as it is now.
struct RobotNow {
  std::vector<double> joint_positions_rad;  ///< estimated; empty: not heard
  int walking_in = -1;                      ///< index of a gait; -1: it does not walk
};

struct OperatorForm {
  std::string name;  ///< of the command: "jump"
  std::string title;
  std::string help;
  OperatorKind kind = OperatorKind::kNone;
  bool held = false;    ///< goes on only while the page that asked is there
  std::string confirm;  ///< a question to be answered with yes first; "" = none
  std::vector<CommandParameter> parameters;
};

/// Those that this robot can do. Emergency stop, hold and enable are no forms: they have keys of their own.
std::vector<OperatorForm> operator_forms(const RobotConfig& robot, const std::string& preset);

nlohmann::ordered_json forms_json(const std::vector<OperatorForm>& forms);

/// @param parameters an object; its keys are those of the form.
/// @throws std::invalid_argument with what is wrong, for people: an unknown command or parameter, a number
/// out of its range or of the wrong type, a gait that does not go so fast.
OperatorCommand command_of(const OperatorForm& form, const RobotConfig& robot, const RobotNow& now,
                           const nlohmann::json& parameters);
/// @throws std::invalid_argument naming those there are.
const OperatorForm& form_named(const std::vector<OperatorForm>& forms, const std::string& name);

}  // namespace sprung::station
