#pragma once
/// Attitude and motion of the trunk, from legs and, where there is one, an IMU. Pure: no I/O, clock, log or
/// heap in step. What it does without: body_attitude.h, BodyMotion; docs/estimation.md.
#include <Eigen/Geometry>

#include "estimator/body_attitude.h"
#include "estimator/body_filter.h"
#include "estimator/imu_input.h"
#include "estimator/imu_mounting.h"
#include "estimator/standing_feet.h"
#include "signals/body_state.h"
#include "signals/joint_state.h"
#include "signals/sensors.h"

namespace sprung {

/// Velocity and height of the trunk over the feet that stand.
///
/// A Kalman filter of velocity and of the specific force's bias, whose noise has no direction, so that each
/// covariance is one number: specific force less its bias moves the velocity (without an IMU it is taken to
/// go on as it is), each standing foot says -(its velocity) - w x (its place), and what its ball has rolled.
/// A foot that disagrees by much, as one that slides, counts less. The bias is the sensor's, and gravity's
/// part along a trunk whose attitude is a little off. The height follows the vertical velocity and is held by
/// the standing feet. In flight both go on for a while, and are then unknown.
class BodyMotion {
 public:
  BodyMotion() noexcept { reset(); }
  void reset() noexcept;
  struct Attitude {
    Eigen::Quaterniond trunk_to_world;
    Eigen::Vector3d angular_velocity_rad_s;  ///< trunk axes
  };
  /// @param imu nullptr: none.
  void step(const ImuReading* imu, const Attitude& attitude, const StandingFeet& feet, double dt_s) noexcept;

  /// False until a foot stands, and when none has stood for half a second.
  bool known() const noexcept { return known_; }
  /// Of the trunk's origin, trunk axes.
  const Eigen::Vector3d& velocity_m_s() const noexcept { return velocity_m_s_; }
  double height_m() const noexcept { return height_m_; }

 private:
  void start(const Attitude& attitude, const StandingFeet& feet) noexcept;
  void predict(const ImuReading* imu, const Attitude& attitude, double dt_s) noexcept;
  void correct(const StandingFoot& foot, const Attitude& attitude, double dt_s) noexcept;
  void follow_height(const Attitude& attitude, const StandingFeet& feet, double dt_s) noexcept;

  bool known_ = false;
  double in_flight_s_ = 0.0;
  double variance_m2_s2_ = 0.0;       ///< of the velocity, each axis
  double covariance_m2_s3_ = 0.0;     ///< with the bias
  double bias_variance_m2_s4_ = 0.0;  ///< of the bias
  Eigen::Vector3d velocity_m_s_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d bias_m_s2_ = Eigen::Vector3d::Zero();  ///< of the IMU's specific force, trunk axes
  double height_m_ = 0.0;
};

class BodyEstimator {
 public:
  explicit BodyEstimator(const RobotConfig& robot);

  /// Starts anew; heading goes on, and how the IMU is mounted.
  void reset() noexcept;
  /// @param legs of this cycle. @param last_link_rates_rad_s with them: what their feet roll with, seen from
  /// the trunk, trunk axes. @param imu newest sample, nullptr: none, as always without robot.body.imu;
  /// its age is the difference of the seqs. Writes all of `out`; NaN: attitude until there was an IMU sample
  /// or three feet stood, velocity and height until a foot stands and when none has stood for half a second.
  /// Never NaN else.
  void step(const std::vector<EstimatedLeg>& legs, const std::vector<Eigen::Vector3d>& last_link_rates_rad_s,
            const Imu* imu, std::int64_t seq, double dt_s, EstimatedBody& out) noexcept;
  /// Odometry after the last step, without a stamp. NaN until an attitude was known and a foot stood.
  void odometry(BodyState& out) const noexcept;
  std::int64_t newest_imu_seq() const noexcept { return imu_.newest_seq(); }  ///< -1: none has come

 private:
  void write(EstimatedBody& out) const noexcept;
  const ImuReading* in_trunk_axes(const ImuReading* reading) noexcept;
  void learn_mounting(double dt_s) noexcept;
  void locate(const ImuReading* reading, double dt_s) noexcept;
  Eigen::Matrix3d attitude_covariance_rad2() const noexcept;
  Eigen::Quaterniond trunk_to_world() const noexcept;
  Eigen::Vector3d velocity_in_trunk_m_s() const noexcept;

  double cycle_s_;
  bool has_imu_;
  ImuInput imu_;
  ImuMounting mounting_;
  ImuReading reading_;
  StandingFeet feet_;
  /// The last ones, as many as the IMU is late: what is late must not be held against what is not.
  std::vector<StandingFeet> past_feet_;
  std::size_t cycles_ = 0;
  BodyAttitude attitude_;
  BodyMotion motion_;
  BodyFilter filter_;
  double late_s_;            ///< of what the filter knows
  double unsure_z_m_ = 0.0;  ///< how far up it may have gone, by an IMU that is askew
  Eigen::Vector3d acceleration_m_s2_ = Eigen::Vector3d::Zero();  ///< world axes
  bool uses_imu_ = false;
};

}  // namespace sprung
