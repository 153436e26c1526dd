#pragma once
/// How far an estimate is from the simulation's truth: windows of a jump, and sums over samples. Pure.
#include <cstdint>

#include "signals/joint_state.h"
#include "signals/motion_state.h"
#include "signals/simulation.h"

namespace sprung {

/// Gear output torque of one joint, sample by sample.
class TorqueScore {
 public:
  /// Samples that the estimator does not stand for (stale, starting, fault) and numbers that are not finite
  /// are left out.
  void add(const EstimatedJoint& estimated, const TrueJoint& truth);
  void add(const TorqueScore& other);

  std::int64_t samples() const { return samples_; }
  double rms_Nm() const;         ///< of gear_output_torque_Nm; NaN without samples, as all here
  double papers_rms_Nm() const;  ///< of motor_side_torque_Nm, the papers' equation (6)
  double covered() const;        ///< share of samples whose error is within the stated bound
  double mean_bound_Nm() const;

 private:
  double mean(double sum) const;

  std::int64_t samples_ = 0;
  double squares_Nm2_ = 0.0;
  double papers_squares_Nm2_ = 0.0;
  double covered_ = 0.0;
  double bounds_Nm_ = 0.0;
};

/// Which part of a jump a cycle belongs to, by the planner's thrust and the true contact force.
class JumpWindow {
 public:
  enum class Part { kOther, kPushOff, kFlight, kLanding };
  /// Landing lasts this long from the first true contact force.
  static constexpr double kLanding_s = 0.15;

  /// Of this cycle; cycles in order.
  Part add(const MotionState& motion, const SimTruth& truth);
  /// In flight or landing, for how long.
  double since_s() const { return 1e-6 * static_cast<double>(now_us_ - since_us_); }
  /// A jump has begun and was followed to the end of its landing.
  bool complete() const { return complete_; }

 private:
  Part part_ = Part::kOther;
  MotionPhase last_phase_ = MotionPhase::kIdle;
  std::int64_t since_us_ = 0;
  std::int64_t now_us_ = 0;
  bool complete_ = false;
};

}  // namespace sprung
