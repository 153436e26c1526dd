#pragma once
/// How far BODY_STATE is from the simulation's truth, and whether it is as sure as it says.
#include <Eigen/Geometry>

#include "signals/body_state.h"
#include "signals/simulation.h"
#include "signals/vec3.h"

namespace sprung {

class OdometryScore {
 public:
  /// One cycle. The first in which BODY_STATE knows a place says where and how its world lies in the true
  /// one.
  void add(const BodyState& estimated, const SimTruth& truth);

  bool begun() const noexcept { return begun_; }
  /// Truly gone, along the ground; in steps of kStep_m, so that a trunk that sways goes no further.
  double way_m() const noexcept { return way_m_; }
  static constexpr double kStep_m = 0.3;
  double position_error_m() const noexcept { return place_m_.norm(); }  ///< now
  double heading_error_rad() const noexcept { return turn_rad_.z(); }   ///< now
  double worst_tilt_rad() const noexcept { return worst_tilt_rad_; }
  /// Since its heading first spanned kTurned_rad: who only went straight cannot know how the IMU is mounted.
  /// NaN before.
  double worst_tilt_when_turned_rad() const noexcept { return worst_turned_rad_; }
  static constexpr double kTurned_rad = 1.5;
  /// In trunk axes: a heading that is off is no error of the speed.
  double velocity_rms_m_s() const noexcept;
  double worst_velocity_m_s() const noexcept { return worst_velocity_m_s_; }
  /// Normalised squared errors of three numbers each (Bar-Shalom 2001): 3 where the covariance is right, in
  /// 95 of 100 independent cases from 0.22 to 9.35. Position now, velocity on average since it was first
  /// known.
  double position_nees() const noexcept { return position_nees_; }
  double velocity_nees() const noexcept;

 private:
  void begin(const BodyState& estimated, const SimTruth& truth);
  void add_tilt(const Eigen::Quaterniond& truly);

  bool begun_ = false;
  Eigen::Quaterniond ours_from_true_ = Eigen::Quaterniond::Identity();
  Eigen::Vector3d origin_m_ = Eigen::Vector3d::Zero();  ///< of our world in the true one
  Eigen::Vector3d last_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d place_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rad_ = Eigen::Vector3d::Zero();
  double way_m_ = 0.0;
  double heading_rad_ = 0.0, rightmost_rad_ = 0.0, leftmost_rad_ = 0.0;  ///< truly, since the beginning
  double worst_turned_rad_ = kNaN;
  double worst_tilt_rad_ = 0.0, worst_velocity_m_s_ = 0.0;
  double velocity_sum_m2_s2_ = 0.0, velocity_nees_sum_ = 0.0, position_nees_ = 0.0;
  int cycles_ = 0;
};

}  // namespace sprung
