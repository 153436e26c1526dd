#include "tools/station/server/parameter_board.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace sprung::station {

ParameterBoard::ParameterBoard(const RobotConfig& robot, const std::string& preset)
    : parameters_(parameters_of(robot, robot.preset(preset))) {
  for (const Parameter& one : parameters_) values_.push_back(one.file);
}

void ParameterBoard::ask_anew() noexcept {
  if (!parameters_.empty() && !behind_) behind_ = 0;
}

void ParameterBoard::give_up() noexcept {
  behind_.reset();
  asked_ = 0;
}

std::optional<OperatorCommand> ParameterBoard::question() const {
  if (!behind_ || asked_ != 0) return std::nullopt;
  OperatorCommand out;
  out.kind = OperatorKind::kReadParameter;
  out.parameter = *behind_;
  return out;
}

bool ParameterBoard::take(const RobotAnswer& answer) {
  const auto place = place_of(parameters_, answer.parameter);
  if (asked_ != 0 && answer.request_id == asked_ && answer.outcome != OperatorOutcome::kQueued) {
    asked_ = 0;
    behind_ = place ? std::optional(answer.parameter) : std::nullopt;
  }
  const bool in_force = answer.outcome == OperatorOutcome::kAccepted ||
                        answer.outcome == OperatorOutcome::kDone;
  if (!place || !in_force) return false;
  return std::exchange(values_[*place], answer.parameter_value) != answer.parameter_value;
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
