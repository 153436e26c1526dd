#include "tools/station/server/parameter_board.h"

#include <nlohmann/json.hpp>

namespace sprung::station {

ParameterBoard::ParameterBoard(const RobotConfig& robot, const std::string& preset)
    : parameters_(parameters_of(robot, robot.preset(preset))) {
  for (const Parameter& one : parameters_) values_.push_back(one.file);
}

void ParameterBoard::ask_anew() noexcept {
  if (parameters_.empty() || next_ >= 0) return;
  next_ = 0;
}

void ParameterBoard::give_up() noexcept {
  next_ = -1;
  asked_ = 0;
}

std::optional<OperatorCommand> ParameterBoard::question() const {
  if (next_ < 0 || asked_ != 0) return std::nullopt;
  OperatorCommand out;
  out.kind = OperatorKind::kReadParameter;
  out.parameter = next_;
  return out;
}

bool ParameterBoard::take(const RobotAnswer& answer) {
  const bool known = answer.parameter >= 0 && answer.parameter < static_cast<int>(values_.size());
  if (asked_ != 0 && answer.request_id == asked_ && answer.outcome != OperatorOutcome::kQueued) {
    asked_ = 0;
    next_ = known && answer.parameter + 1 < static_cast<int>(values_.size()) ? answer.parameter + 1 : -1;
  }
  const bool in_force = answer.outcome == OperatorOutcome::kAccepted ||
                        answer.outcome == OperatorOutcome::kDone;
  if (!known || !in_force) return false;
  double& value = values_[static_cast<std::size_t>(answer.parameter)];
  const bool changed = value != answer.parameter_value;
  value = answer.parameter_value;
  return changed;
}

nlohmann::ordered_json ParameterBoard::table_json() const {
  nlohmann::ordered_json out = nlohmann::ordered_json::array();
  for (const Parameter& one : parameters_)
    out.push_back({{"name", one.name},
                   {"unit", one.unit},
                   {"least", one.least},
                   {"most", one.most},
                   {"file", one.file},
                   {"tightens_only", one.tightens_only},
                   {"meaning", one.meaning}});
  return out;
}

nlohmann::ordered_json ParameterBoard::values_json() const { return values_; }

}  // namespace sprung::station
