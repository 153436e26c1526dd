#pragma once
/// Judges every DRIVE_COMMAND before it can reach a drive, and remembers the last good one. Pure.
#include <cstdint>
#include <vector>

#include "drivers/bridge/detail_text.h"
#include "robots/robot_config.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"

namespace sprung {

class CommandGate {
 public:
  explicit CommandGate(const RobotConfig& robot);

  /// @param cycle the current one; @param state what the drives measured in it.
  /// Refused, counted and named in detail(): another number of actuators; seq not newer than the last good
  /// one, or of a cycle that has not been; expired, or valid for more than a second; unknown mode; a number
  /// that its mode uses and that is not finite; |torque| above the actuator's limit (a thousandth more is
  /// rounding); damping below 0 or above 10 times safety_damping; a position more than 20 rad from the
  /// measured one.
  bool accept(const DriveCommand& command, std::int64_t cycle, std::int64_t time_us,
              const DriveState& state) noexcept;

  const DriveCommand& last() const noexcept { return last_; }
  bool any() const noexcept { return any_; }  ///< a good command has come at all
  /// Cycles from the last good command's to `cycle`. Only when any().
  std::int64_t age_cycles(std::int64_t cycle) const noexcept { return cycle - last_.stamp.seq; }
  /// Torque is allowed only after a good command with every mode disabled, so that neither a restart nor a
  /// clear turns torque back on.
  bool armed() const noexcept { return armed_; }
  void disarm() noexcept { armed_ = false; }

  std::int64_t refused() const noexcept { return refused_; }
  bool last_was_refused() const noexcept { return last_was_refused_; }
  const DetailText& detail() const noexcept { return detail_; }

 private:
  bool judge(const DriveCommand& command, std::int64_t cycle, std::int64_t time_us,
             const DriveState& state) noexcept;
  bool judge_actuator(std::size_t i, const ActuatorCommand& command, const ActuatorState& state) noexcept;

  std::vector<ActuatorConfig> actuators_;
  DriveCommand last_;
  bool any_ = false;
  bool armed_ = false;
  bool last_was_refused_ = false;
  std::int64_t refused_ = 0;
  DetailText detail_{};
};

}  // namespace sprung
