#pragma once
/// `sprung experiment bring_up`: what a robot team would do with a robot whose gears nobody knows. A plant is
/// drawn from a family of friction, every joint of it is recorded with and without a known weight at its
/// foot, identified, and written into a robot folder; then the estimate, contact, foot return, landings and
/// gaits are scored on that plant, with this folder and beside it with robot.yaml as it was shipped.
#include <string>
#include <vector>

#include "tools/lab/identify/identified_robot.h"
#include "tools/lab/identify/record_protocol.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

/// One guided recording: what hangs at the foot, and how warm it is.
struct BringUpPass {
  double foot_weight_kg = 0.0;
  double temperature_degC = 24.0;
};

/// Without and with a weight that loads the joint with a fifth of what its actuator gives, and the same warm:
/// the law is that of a gear on more than one day.
std::vector<BringUpPass> bring_up_passes(const RobotConfig& robot, int joint);

/// What is recorded and fitted; shorter ones for tests.
struct BringUpProtocol {
  identify::RecordOptions recording{};
  /// Models that are compared, as `sprung identify --models`.
  std::string models = kModels;
  std::string command;  ///< that makes it again: stands in robot.yaml
  static const char* const kModels;
};

/// Every joint of the robot on this plant, recorded and identified. @param sim the plant, by --plant's keys.
/// @throws CaseError naming the joint's number where one cannot be recorded or identified.
std::vector<identify::RobotChange> bring_up_joints(const RobotConfig& robot, const SimOptions& sim,
                                                   const BringUpProtocol& protocol,
                                                   const ParallelOptions& parallel);

Experiment bring_up_experiment();

}  // namespace sprung
