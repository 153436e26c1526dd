#pragma once
/// Attitude and motion of the trunk, from legs and, where there is one, an IMU. Pure: no I/O, clock, log or
/// heap in step. What it does without: body_attitude.h, body_motion.h; docs/estimation.md.
#include "estimator/body_attitude.h"
#include "estimator/body_motion.h"
#include "estimator/imu_input.h"
#include "estimator/standing_feet.h"
#include "signals/joint_state.h"
#include "signals/sensors.h"

namespace sprung {

class BodyEstimator {
 public:
  explicit BodyEstimator(const RobotConfig& robot);

  /// Starts anew; heading goes on.
  void reset() noexcept;
  /// @param legs of this cycle. @param imu newest sample, nullptr: none, as always without robot.body.imu;
  /// its age is the difference of the seqs. Writes all of `out`; NaN: attitude until there was an IMU sample
  /// or three feet stood, velocity and height until a foot stands and when none has stood for half a second.
  /// Never NaN else.
  void step(const std::vector<EstimatedLeg>& legs, const Imu* imu, std::int64_t seq, double dt_s,
            EstimatedBody& out) noexcept;
  std::int64_t newest_imu_seq() const noexcept { return imu_.newest_seq(); }  ///< -1: none has come

 private:
  void write(EstimatedBody& out) const noexcept;

  double cycle_s_;
  bool has_imu_;
  ImuInput imu_;
  StandingFeet feet_;
  BodyAttitude attitude_;
  BodyMotion motion_;
};

}  // namespace sprung
