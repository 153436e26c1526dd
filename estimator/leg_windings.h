#pragma once
/// How warm the motors of one leg's joints are, by the currents that their drives measure. Pure: no heap
/// after construction.
#include <cstdint>
#include <vector>

#include "model/transmission.h"
#include "model/winding_watch.h"
#include "robots/robot_config.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"

namespace sprung {

class LegWindings {
 public:
  LegWindings(const RobotConfig& robot, const LegConfig& leg);

  /// One cycle; a drive that did not answer goes on with the current that it had.
  void step(const std::vector<ActuatorState>& actuators, double dt_s) noexcept;
  /// Of the warmest motor that moves this joint of the leg.
  void write(std::size_t joint, EstimatedJoint& out) const noexcept;

 private:
  struct Motor {
    std::size_t actuator = 0;  ///< of the robot's
    bool known = false;        ///< its time constant
    WindingWatch winding;
  };
  Transmission transmission_;
  std::vector<Motor> motors_;
  std::int64_t time_us_ = 0;
};

}  // namespace sprung
