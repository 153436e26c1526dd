#pragma once
/// What a jump was worth: fed once a cycle with the planner's state, the estimate and the simulation's truth.
/// Pure.
///
/// Height is the hip's rise above where it was at lift-off (errata E11) and counts only if the leg lands
/// upright: it stays off its folded stop and stands again. Touchdown is counted from the start of the thrust.
/// "Peak" is the papers' signal (motor side); the gear output beside it is the truth (errata E8).
#include <cstdint>
#include <vector>

#include "robots/robot_config.h"
#include "signals/signals.h"

namespace sprung {

struct JumpResult {
  double height_mm = kNaN;
  double touchdown_time_ms = kNaN;
  double peak_hip_torque_Nm = kNaN;  ///< motor side, thrust start to touchdown
  double peak_knee_torque_Nm = kNaN;
  double peak_knee_output_torque_Nm = kNaN;     ///< truth, the same span
  double landing_knee_torque_Nm = kNaN;         ///< motor side, 0.3 s from touchdown
  double landing_knee_output_torque_Nm = kNaN;  ///< truth, the same span
  double lowest_hip_m = kNaN;                   ///< after touchdown
  bool upright = false;
};

class JumpMetrics {
 public:
  /// Joints are found by name: "hip" and "knee". @throws std::invalid_argument where the robot has none.
  explicit JumpMetrics(const RobotConfig& robot);

  void add(const MotionState& motion, const JointState& joints, const SimTruth& truth);
  /// Every jump whose thrust began; the last may be unfinished (upright false).
  const std::vector<JumpResult>& jumps() const { return jumps_; }

 private:
  enum class Span { kNone, kGround, kAir, kLanded };
  void begin_jump(std::int64_t time_us);
  void follow_peaks(const JointState& joints, const SimTruth& truth);
  void follow_flight(const SimTruth& truth);
  void follow_landing(const MotionState& motion, const JointState& joints, const SimTruth& truth);

  std::size_t hip_;
  std::size_t knee_;
  double folded_knee_rad_;
  std::vector<JumpResult> jumps_;
  Span span_ = Span::kNone;
  MotionPhase last_phase_ = MotionPhase::kIdle;
  std::int64_t thrust_us_ = 0;
  std::int64_t liftoff_us_ = 0;
  std::int64_t touchdown_us_ = 0;
  double liftoff_height_m_ = 0.0;
  double top_height_m_ = 0.0;
  bool folded_ = false;
};

}  // namespace sprung
