#pragma once
/// Where the trunk is, how it moves, and how sure that is. Pure: no heap.
///
/// A contact-aided invariant extended Kalman filter (facts D14, docs/sources.md): attitude, velocity and
/// position of the trunk, biases of gyro and specific force, and the place of each foot that stands. Errors
/// are right-invariant, in world axes, so that what no sensor shows, heading and position, is never taken for
/// seen. Gyro and specific force predict; that a standing foot stays where it is, but for its ball's rolling
/// and what it sinks in by its load, and a tilt, correct. How far a newton makes it sink is learned: feet
/// come down to a load and leave without one, and would otherwise lift the world a little with each step.
///
/// A trunk that no foot has held for half a second hangs, or lies: it is taken to be about at rest, or the
/// force's bias would carry it away by kilometres in an hour.
///
/// A foot whose place surprises more than its uncertainty allows slips, or never stood: it is taken to
/// stand anew where it is, and counted.
#include <Eigen/Geometry>
#include <array>

#include "estimator/rotation.h"
#include "estimator/standing_feet.h"

namespace sprung {

/// What moves the trunk in this cycle, and how far up is known; trunk axes.
struct BodyMeasurement {
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();
  /// NaN: none; the velocity is then taken to go on as it is.
  Eigen::Vector3d specific_force_m_s2 = Eigen::Vector3d::Constant(kNaN);
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  ///< unit vector
  bool has_up = false;
  bool by_imu = false;  ///< else by feet: less sure, and no biases to learn
};

class BodyFilter {
 public:
  BodyFilter() noexcept;
  static constexpr int kLegs = 4;  ///< more are not looked at
  static constexpr int kStates = 15 + 3 * kLegs + 1;

  /// Heading and position go on from before, if there was one; else the heading is that of `tilted`.
  void start(const Eigen::Quaterniond& tilted) noexcept;
  /// Until the next start.
  void stop() noexcept { runs_ = false; }
  bool runs() const noexcept { return runs_; }
  /// The trunk's axes are others than was thought, by this, in trunk axes: its attitude, and that alone.
  void turn_trunk(const Eigen::Vector3d& by_rad) noexcept { attitude_ = attitude_ * turned_by(by_rad); }
  /// Predicts; every hundredth of a second it corrects.
  void step(const BodyMeasurement& measured, const StandingFeet& feet, double dt_s) noexcept;

  const Eigen::Quaterniond& trunk_to_world() const noexcept { return attitude_; }
  /// Of the trunk's origin from where it was first known; world axes.
  const Eigen::Vector3d& position_in_world_m() const noexcept { return position_m_; }
  /// By what was measured, less biases. Zero where the force is none.
  Eigen::Vector3d acceleration_in_world_m_s2(const BodyMeasurement& measured) const noexcept;
  const Eigen::Vector3d& velocity_in_world_m_s() const noexcept { return velocity_m_s_; }
  Eigen::Vector3d velocity_in_trunk_m_s() const noexcept { return attitude_.conjugate() * velocity_m_s_; }
  const Eigen::Vector3d& rate_bias_rad_s() const noexcept { return rate_bias_rad_s_; }
  const Eigen::Vector3d& force_bias_m_s2() const noexcept { return force_bias_m_s2_; }

  double sinks_m_N() const noexcept { return sinks_m_N_; }  ///< foot and ground together

  /// Of small errors about world axes, but for an IMU that is mounted askew; of position and velocity in
  /// world axes, with what no sensor here can show: legs that are longer than robot.yaml says.
  Eigen::Matrix3d attitude_covariance_rad2() const noexcept;
  Eigen::Matrix3d velocity_covariance_m2_s2() const noexcept;
  Eigen::Matrix3d position_covariance_m2() const noexcept;
  int slips() const noexcept { return slips_; }  ///< since the start

 private:
  using Covariance = Eigen::Matrix<double, kStates, kStates>;
  using Rows = Eigen::Matrix<double, 3, kStates>;
  using Gain = Eigen::Matrix<double, kStates, 3>;
  struct Foot {
    bool anchored = false;
    Eigen::Vector3d in_world_m = Eigen::Vector3d::Zero();
  };

  void predict(const BodyMeasurement& measured, const StandingFeet& feet, double dt_s) noexcept;
  void spread(const BodyMeasurement& measured, const StandingFeet& feet, double dt_s) noexcept;
  template <class Block>
  void flow(const Block& block, bool biases, double dt_s) const noexcept;
  void add_rate_noise(double density, double dt_s) noexcept;
  void correct_tilt(const BodyMeasurement& measured, double dt_s) noexcept;
  void rest(double dt_s) noexcept;
  void follow_foot(int leg, const StandingFoot& foot, double dt_s) noexcept;
  Eigen::Matrix3d place_covariance_m2() const noexcept;  ///< without what is the same all the time
  Eigen::Vector3d ground_below(const StandingFoot& foot) const noexcept;
  void anchor(int leg, const StandingFoot& foot) noexcept;
  void release(int leg) noexcept;
  void move_by(const Eigen::Matrix<double, kStates, 1>& error) noexcept;

  bool runs_ = false;
  bool was_started_ = false;
  Eigen::Quaterniond attitude_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d velocity_m_s_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d position_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate_bias_rad_s_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d force_bias_m_s2_ = Eigen::Vector3d::Zero();
  std::array<Foot, kLegs> feet_{};
  double sinks_m_N_;
  double uncorrected_s_ = 0.0;
  double unheld_s_ = 0.0;  ///< for which no foot has held it
  double way_m_ = 0.0;     ///< along the ground
  int slips_ = 0;
  Covariance covariance_ = Covariance::Zero();
};

}  // namespace sprung
