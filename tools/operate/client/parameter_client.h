#pragma once
/// Parameters of a robot that is up (robots/parameters.h), read from its planner and set there.
#include <string>
#include <vector>

#include "robots/parameters.h"
#include "tools/operate/client/operator_client.h"

namespace sprung {

class ParameterClient {
 public:
  /// @throws ConfigError as load_robot(), std::runtime_error as OperatorClient.
  explicit ParameterClient(const RunInfo& info);

  const std::vector<Parameter>& parameters() const noexcept { return parameters_; }
  const RobotConfig& robot() const noexcept { return robot_; }
  const std::string& preset() const noexcept { return preset_; }
  /// As they are wanted now, one for each. @throws std::runtime_error where the planner does not answer, or
  /// has other parameters.
  std::vector<double> read();
  /// @return the first answer; nullopt: there was none.
  std::optional<OperatorAnswer> set(const Parameter& parameter, double value);
  /// What differs from robot.yaml, and what the overlay has for other presets.
  std::vector<OverlaidNumber> overlay(const std::vector<double>& values) const;

 private:
  OperatorAnswer next_changed(std::int64_t behind);

  RobotConfig robot_;
  std::string preset_;
  std::vector<Parameter> parameters_;
  OperatorClient client_;
};

/// A line for each: name, value, unit, range, robot.yaml's own where it is another, meaning.
/// @param values one for each. @param changed_only those that are not robot.yaml's.
std::string parameter_table(const std::vector<Parameter>& parameters, const std::vector<double>& values,
                            bool changed_only);

}  // namespace sprung
