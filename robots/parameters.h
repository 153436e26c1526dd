#pragma once
/// Numbers of robot.yaml that may change while the robot runs: gains, heights, thresholds, limits. Each is
/// declared once, in parameters.cpp, with unit, range and meaning; operators, planner and the overlay file
/// read it there. Start-up only, but for at().
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"

namespace sprung {

/// What of a robot they are parts of.
struct AdjustableConfig {
  PresetConfig preset;
  std::vector<GaitConfig> gaits;
  BodyConfig body;
};

AdjustableConfig adjustable_of(const RobotConfig& robot, const PresetConfig& preset);

struct Parameter {
  /// Of its name, the same in every build and for every robot: what messages say. Above 0, and exact as a
  /// double.
  std::int64_t id = 0;
  /// Way to it in robot.yaml: from the preset on, "compliance.stiffness.z", or of the robot,
  /// "gaits.trot.lift".
  std::string name;
  std::string unit;  ///< "" = a bare number
  std::string meaning;
  double file = 0.0;           ///< robot.yaml's own, whatever an overlay says
  double least = 0.0;          ///< that it may be set to
  double most = 0.0;           ///< likewise
  bool tightens_only = false;  ///< one end of the range is robot.yaml's own
  bool moves_body = false;     ///< a robot that stands goes there: only while it stands, walks or is off

  double& at(AdjustableConfig& config) const noexcept { return place(config, index); }
  double at(const AdjustableConfig& config) const noexcept {
    return place(const_cast<AdjustableConfig&>(config), index);
  }
  bool allows(double value) const noexcept { return value >= least && value <= most; }

  double& (*place)(AdjustableConfig& config, int index) noexcept = nullptr;
  int index = 0;  ///< axis, or gait
};

/// All of a robot under a preset, in the order of parameters.cpp. A number that is 0 and can only be
/// multiplied is none of them.
std::vector<Parameter> parameters_of(const RobotConfig& robot, const PresetConfig& preset);

/// Id of the one of that name, whether there is one or not.
std::int64_t parameter_id(const std::string& name) noexcept;
/// Place of the one of that id; nothing: there is none.
std::optional<std::size_t> place_of(const std::vector<Parameter>& parameters, std::int64_t id) noexcept;

/// Place of the one of that name. @throws std::invalid_argument naming the nearest.
std::size_t parameter_named(const std::vector<Parameter>& parameters, const std::string& name);

/// Its way from the top of robot.yaml: "presets.best.compliance.stiffness.z".
std::string path_of(const Parameter& parameter, const std::string& preset);

}  // namespace sprung
