#pragma once
/// Where the ground is: a plane through the places where feet stood last. Level axes of the trunk
/// (body_frame.h), which go along with it. Pure, no heap.
#include <Eigen/Geometry>
#include <array>

#include "planner/gait/gait_clock.h"
#include "signals/vec3.h"

namespace sprung {

struct GroundFoot {
  Eigen::Vector3d at_m = Eigen::Vector3d::Zero();  ///< measured
  bool stands = false;
};

/// The trunk moves over the ground, and another foot that stands is other ground. Whatever is in the air
/// follows the former at once; the latter is learned slowly, since a drive's position loop passes on every
/// jerk of its set-point, and what jerks feigns contact.
///
/// Height: of the feet that stand. Slope: least squares through the last footprint of every foot, which the
/// feet that stand show going by under the trunk. Footprints that lie in no plane are stones: the rougher the
/// ground, the slower its slope is learned.
class GroundPlane {
 public:
  using Feet = std::array<GroundFoot, kMostLegs>;

  /// Takes those that stand for the ground; nothing of before is left.
  void begin(const Feet& feet, double yaw_rad) noexcept;
  /// @param yaw_rad the trunk's heading. @param period_s in which every foot steps once.
  void follow(const Feet& feet, double yaw_rad, double period_s, double dt_s) noexcept;

  /// Under the trunk's origin: minus its height, along the vertical.
  double z_m() const noexcept { return z_m_; }
  double z_m(const Eigen::Vector3d& place_m) const noexcept { return z_m_ + slope_.dot(place_m.head<2>()); }
  /// Expected under a foot that is to come down there: on smooth ground by the newest footprints alone, so
  /// that a ramp is met by the second foot on it; on stones by the plane.
  double expected_z_m(const Eigen::Vector3d& place_m) const noexcept {
    return z_m_ + newest_slope_.dot(place_m.head<2>());
  }
  /// Rise over way, along x (heading) and y (left).
  const Eigen::Vector2d& slope() const noexcept { return slope_; }
  /// Of the slope along x and y, and of the ground's height where a foot is to come down: errors are below
  /// them at about 95 %, as far as footprints and their roughness show.
  Eigen::Vector2d slope_bound() const noexcept;
  double z_bound_m() const noexcept;
  /// By which the trunk came down toward the plane in the last cycle, as the feet show that stood before and
  /// after it.
  double sunk_m() const noexcept { return sunk_m_; }

  /// Steeper is not learned: [design choice] 22 degrees, more than legs of any robot here hold on rubber.
  static constexpr double kSteepest = 0.4;

 private:
  /// [design choice] so that a first stone is not a ramp
  static constexpr double kUsualOff = 0.1;
  struct Fit {
    Eigen::Vector2d slope;
    Eigen::Vector2d slope_per_m2 = Eigen::Vector2d::Constant(kNaN);  ///< its variance, by that of heights
    double rough_m2 = 0.0;  ///< variance of a footprint's height: four of them leave one degree of freedom
  };
  Fit fit() const noexcept;
  double trend(const Eigen::Vector2d& off, double period_s, double dt_s) noexcept;
  void learn(double period_s, double dt_s) noexcept;
  void carry_prints(const Feet& feet, double turned_rad) noexcept;

  double z_m_ = 0.0;
  Eigen::Vector2d slope_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d newest_slope_ = Eigen::Vector2d::Zero();
  double sunk_m_ = 0.0;
  double rough_m2_ = 0.0;                          ///< of late
  Eigen::Vector2d off_ = Eigen::Vector2d::Zero();  ///< of the slope from the footprints', smoothed
  double off_length_ = kUsualOff;                  ///< the same of its length
  double yaw_rad_ = 0.0;
  Feet before_{};
  std::array<Eigen::Vector3d, kMostLegs> print_m_{};  ///< written where has_print_
  std::array<bool, kMostLegs> has_print_{};
};

}  // namespace sprung
