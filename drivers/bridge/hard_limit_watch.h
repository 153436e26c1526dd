#pragma once
/// Where limiting has not helped, the robot is stopped: a joint with power that is more than 0.08 rad beyond
/// its limits for 30 ms, or an actuator that turns faster than 1.2 times its speed limit for 20 ms. A joint
/// that was further out when its power came on may come back, and is not stopped until it goes 0.02 rad
/// further still. Pure; once a cycle.
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "drivers/bridge/setpoint_gate.h"
#include "model/transmission.h"
#include "robots/robot_config.h"
#include "signals/modes.h"

namespace sprung {

struct Fault;

class HardLimitWatch {
 public:
  explicit HardLimitWatch(const RobotConfig& robot);

  void judge(const std::vector<GateMotion>& motion, std::int64_t time_us) noexcept;
  /// @return whether a limit is passed in this cycle: kJointLimit or kOverspeed, with actuator and sentence.
  bool fault(Fault& out) const noexcept;

 private:
  struct Joint {
    JointConfig config;
    /// Beyond its limits; shrinks while it comes back. Without power anything.
    double allowed_rad = std::numeric_limits<double>::infinity();
    double position_rad = 0.0;
    std::int64_t inside_us = 0;  ///< when it was last seen no further
    bool beyond = false;
  };
  struct Leg {
    Transmission transmission;
    std::vector<int> actuators;
    std::vector<Joint> joints;
  };
  struct Drive {
    std::string name;
    double limit_rad_s;
    double velocity_rad_s = 0.0;
    std::int64_t slow_us = 0;  ///< when it was last seen no faster
    bool fast = false;
  };

  static void judge_joint(Joint& joint, double position_rad, bool powered, std::int64_t time_us) noexcept;
  void judge_leg(Leg& leg, const std::vector<GateMotion>& motion, std::int64_t time_us) noexcept;

  bool any_ = false;  ///< beyond, or fast
  std::vector<Leg> legs_;
  std::vector<Drive> drives_;
};

}  // namespace sprung
