#pragma once
/// How a robot on legs fares, cycle by cycle: falls, safety trips, how near its drives come to their limits.
/// Pure.
#include <string>

#include "robots/robot_config.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/motion_state.h"
#include "signals/safety_state.h"
#include "signals/simulation.h"
#include "signals/vec3.h"

namespace sprung {

/// What one cycle shows of it.
struct VitalSigns {
  const DriveState& drives;
  const JointState& joints;
  const MotionState& motion;
  const SafetyState& safety;
  const SimTruth& truth;
};

struct WalkVitals {
  bool fell = false;    ///< truly: tilted or sunk as robot.yaml's `fallen` says; or the planner says so
  bool caught = false;  ///< the planner noticed, and damped
  double fell_at_s = kNaN;
  std::string why;  ///< of the fall, or of the first trip
  int trips = 0;    ///< times that safety left `operational`; who has fallen may hit what he likes
  double watched_s = 0.0;
  double saturated_share = 0.0;  ///< of all joints and cycles: drive at its torque limit
  double fastest_rad_s = 0.0;    ///< true joint speed
  double strongest_Nm = 0.0;     ///< true motor torque at the gear's output side
};

class VitalsWatch {
 public:
  explicit VitalsWatch(const RobotConfig& robot) noexcept;
  /// Once a cycle, from when the robot stands.
  void add(const VitalSigns& now);
  const WalkVitals& result() const noexcept { return result_; }

 private:
  void watch_fall(const VitalSigns& now);
  void watch_safety(const VitalSigns& now);
  void watch_drives(const VitalSigns& now);

  const BodyConfig body_;
  const double cycle_s_;
  double cycles_ = 0.0;
  double saturated_ = 0.0;
  bool operational_ = true;
  WalkVitals result_;
};

/// Truly on the ground, whatever the stack believes. @param body robot.yaml's `fallen`.
bool truly_fallen(const SimTruth& truth, const BodyConfig& body) noexcept;

}  // namespace sprung
