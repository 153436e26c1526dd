#pragma once
/// The robot's parameters (robots/parameters.h) as a page shows them: what they are, and their values as the
/// planner's answers tell them, whoever asked. Pure.
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "robots/parameters.h"
#include "signals/operator.h"
#include "tools/station/server/request_desk.h"

namespace sprung::station {

class ParameterBoard {
 public:
  ParameterBoard(const RobotConfig& robot, const std::string& preset);

  /// They are to be read once more from the planner, unless that is under way.
  void ask_anew() noexcept;
  void give_up() noexcept;  ///< nobody answers
  /// The next question, where one is due; the caller says under which id it is asked.
  std::optional<OperatorCommand> question() const;
  void asked(std::int64_t request_id) noexcept { asked_ = request_id; }
  /// Any answer of the robot. @return whether a value is another one now.
  bool take(const RobotAnswer& answer);

  nlohmann::ordered_json table_json() const;   ///< name, unit, range, robot.yaml's value, meaning of each
  nlohmann::ordered_json values_json() const;  ///< in the same order

 private:
  std::vector<Parameter> parameters_;
  std::vector<double> values_;
  std::optional<std::int64_t> behind_;  ///< which one is to be asked; nothing: all is known
  std::int64_t asked_ = 0;              ///< request id of the question that is under way; 0: none
};

}  // namespace sprung::station
