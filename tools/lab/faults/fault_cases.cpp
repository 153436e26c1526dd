#include <limits>

#include "tools/lab/faults/fault_experiment.h"

namespace sprung {
namespace {

/// Nothing on the bus shows it: the estimator's business.
constexpr double kUnnoticed_s = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<FaultCase> fault_cases(const RobotConfig& robot) {
  using Kind = FaultKind;
  using Cause = SafetyCause;
  const WatchdogConfig& watchdogs = robot.watchdogs;
  const bool can_home = robot.actuators.back().reference.method != ReferenceMethod::kNone;
  const double at_once_s = 4 * robot.cycle_s;  // on the bus in this cycle, seen in the next, with one for
                                               // luck on each side
  const double silence_s = (watchdogs.silent_cycles + 4) * robot.cycle_s;
  const double heartbeat_s = watchdogs.drive_heartbeat_s + 2 * watchdogs.heartbeat_s;
  const double noise_s = 0.03;       // drivers/bridge/noisy_encoder_watch.h
  const double statistical_s = 1.0;  // depends on which frames are hit
  return {
      {Kind::kOverCurrent, false, 0.0, 0.5, Cause::kDriveFault, at_once_s},
      {Kind::kUnderVoltage, false, 0.0, 0.5, Cause::kDriveFault, at_once_s},
      {Kind::kOverTemperature, false, 0.0, 0.5, Cause::kDriveFault, at_once_s},
      {Kind::kEncoderJump, false, 0.5, 0.5, Cause::kImplausible, at_once_s, can_home},
      {Kind::kEncoderStuck, false, 0.0, 0.5, Cause::kNone, kUnnoticed_s},
      {Kind::kEncoderNoise, false, 0.0002, 0.5, Cause::kNone, kUnnoticed_s},
      {Kind::kEncoderNoise, false, 0.005, 0.5, Cause::kImplausible, noise_s},
      {Kind::kCurrentOffset, false, 0.5, 0.5, Cause::kNone, kUnnoticed_s},
      {Kind::kHeartbeatStopped, false, 0.0, 1.0, Cause::kDriveSilent, heartbeat_s},
      {Kind::kFramesLost, false, 1.0, 0.5, Cause::kDriveSilent, silence_s},
      {Kind::kFramesLost, false, 0.02, 0.5, Cause::kNone, statistical_s},
      // Each answer comes in the next cycle's place: only the first gap and the doubled last one can be seen.
      {Kind::kFramesLate, false, 1.2 * robot.cycle_s, 0.5, Cause::kNone, silence_s},
      {Kind::kFramesDuplicated, false, 0.05, 0.5, Cause::kNone, statistical_s},
      {Kind::kFramesFlipped, false, 0.2, 1.0, Cause::kImplausible, statistical_s},
      {Kind::kShortPdo, false, 0.0, 0.5, Cause::kDriveSilent, silence_s},
      {Kind::kPowerCycle, false, 0.0, 0.3, Cause::kDriveSilent, silence_s},
      {Kind::kDuplicateNode, false, 0.0, 0.5, Cause::kDuplicateNode, 0.1},
      {Kind::kBusOff, true, 0.0, 0.5, Cause::kBusLost, at_once_s},
      {Kind::kErrorPassive, true, 0.0, 0.5, Cause::kBusLost, at_once_s},
      {Kind::kLinkDown, true, 0.0, 0.5, Cause::kBusLost, at_once_s},
      {Kind::kQueueFull, true, 0.0, 0.5, Cause::kBusLost, silence_s},
  };
}

}  // namespace sprung
