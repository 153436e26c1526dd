#pragma once
/// What a jump was worth: fed once a cycle with the planner's state, the estimate and the simulation's truth.
/// Pure.
///
/// As facts C2 count: the leg takes off when its foot leaves the floor and touches down when it is there
/// again. (The soft floor is still dented by some millimetres when its force is gone, 10 ms and 27 mm of hip
/// height earlier.) Height is the hip's rise above where it was at take-off (errata E11) and counts only if
/// the leg lands upright: it stays off its folded stop and stands again. Peaks of the jump are those of the
/// push-off, from the start of the thrust to take-off; "peak" is the papers' signal (motor side), the gear
/// output beside it is the truth (errata E8).
#include <cstdint>
#include <vector>

#include "robots/robot_config.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/simulation.h"
#include "signals/vec3.h"

namespace sprung {

struct JumpResult {
  double height_mm = kNaN;
  double takeoff_time_ms = kNaN;    ///< from the start of the thrust
  double touchdown_time_ms = kNaN;  ///< the same
  double touchdown_leg_mm = kNaN;   ///< length of the leg then
  double time_to_peak_ms = kNaN;    ///< of the knee, motor side; from the first set-point of the thrust
  double y_lag_ms = kNaN;           ///< longest leg behind the longest desired leg
  double positive_work_J = 0.0;     ///< of both motors to take-off, truth: integral of what power is positive
  double peak_hip_torque_Nm = kNaN;  ///< push-off
  double peak_knee_torque_Nm = kNaN;
  double peak_hip_output_torque_Nm = kNaN;
  double peak_knee_output_torque_Nm = kNaN;
  double flight_knee_torque_Nm = kNaN;  ///< motor side, from take-off to touchdown: the leg is drawn in
  double landing_hip_torque_Nm = kNaN;  ///< motor side, 0.3 s from touchdown
  double landing_knee_torque_Nm = kNaN;
  double landing_hip_output_torque_Nm = kNaN;
  double landing_knee_output_torque_Nm = kNaN;
  double lowest_hip_m = kNaN;  ///< after touchdown
  bool upright = false;
};

class JumpMetrics {
 public:
  /// Joints are found by name: "hip" and "knee". @param floor_m height of the floor in the world.
  /// @throws std::invalid_argument where the robot has none.
  explicit JumpMetrics(const RobotConfig& robot, double floor_m = 0.0);

  /// @param desired LEG_COMMAND of this cycle; nullptr where nobody listens to it: no lag then.
  void add(const MotionState& motion, const JointState& joints, const SimTruth& truth,
           const LegCommand* desired = nullptr);
  /// Every jump whose thrust began; the last may be unfinished (upright false).
  const std::vector<JumpResult>& jumps() const { return jumps_; }

 private:
  enum class Span { kNone, kGround, kAir, kLanded };
  void begin_jump(std::int64_t time_us);
  void follow_lengths(const SimTruth& truth, const LegCommand* desired);
  void follow_peaks(const JointState& joints, const SimTruth& truth);
  void follow_push_off(const JointState& joints, const SimTruth& truth);
  void follow_flight(const SimTruth& truth);
  void touch_down(const SimTruth& truth);
  void follow_landing(const MotionState& motion, const JointState& joints, const SimTruth& truth);
  double since_thrust_ms(std::int64_t time_us) const {
    return 1e-3 * static_cast<double>(time_us - thrust_us_);
  }

  std::size_t hip_;
  std::size_t knee_;
  double folded_knee_rad_;
  double cycle_s_;
  double standing_foot_m_;  ///< height of a foot that just touches the floor
  std::vector<JumpResult> jumps_;
  Span span_ = Span::kNone;
  MotionPhase last_phase_ = MotionPhase::kIdle;
  std::int64_t thrust_us_ = 0;
  std::int64_t takeoff_us_ = 0;
  std::int64_t touchdown_us_ = 0;
  std::int64_t longest_us_ = 0;  ///< when the leg was longest
  std::int64_t longest_desired_us_ = 0;
  double longest_m_ = 0.0;
  double longest_desired_m_ = 0.0;
  double takeoff_height_m_ = 0.0;
  double top_height_m_ = 0.0;
  bool folded_ = false;
};

}  // namespace sprung
