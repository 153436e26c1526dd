#include "planner/gait/ground_plane.h"

#include <algorithm>
#include <cmath>

#include "planner/gait/body_frame.h"

namespace sprung {
namespace {

constexpr double kLearned_m_s = 0.1;  // 20 mm in half a swing of a trot
/// [design choice] Roughness that halves the trust in a slope: below it a trot is late at the foot of a ramp,
/// above it the crawl's touchdowns on stones grow harder.
constexpr double kSmooth_m = 0.01;
constexpr double kSlopePeriods = 0.75;  // in which two thirds of a smooth slope are learned
/// Over which it is seen whether the footprints' slope goes one way, as on a ramp, or to and fro, as on
/// stones.
constexpr double kTrendPeriods = 2.0;
constexpr double kRoughPeriods = 6.0;  // in which roughness that was seen fades
/// Spread of the footprints below which they show no slope; pegasus' lie 0.7 x 0.35 m apart.
constexpr double kLeastSpread_m = 0.03;
/// [design choice] of a foot by its leg's kinematics, standard deviation
constexpr double kFootHeight_m = 0.005;
constexpr double kTwoSigma = 2.0;  // 95 %

Eigen::Vector3d turned(const Eigen::Vector3d& v, double by_rad) noexcept {
  const double c = std::cos(by_rad), s = std::sin(by_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y(), v.z()};
}

}  // namespace

void GroundPlane::begin(const Feet& feet, double yaw_rad) noexcept {
  *this = GroundPlane{};
  yaw_rad_ = yaw_rad;
  double sum_m = 0.0;
  int standing = 0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (!feet[i].stands) continue;
    print_m_[i] = feet[i].at_m;
    has_print_[i] = true;
    ++standing;
  }
  if (standing == 0) return;
  const Fit found = fit();
  slope_ = newest_slope_ = found.slope;
  rough_m2_ = found.rough_m2;
  for (const GroundFoot& foot : feet)
    if (foot.stands) sum_m += foot.at_m.z() - slope_.dot(foot.at_m.head<2>());
  z_m_ = sum_m / standing;
}

/// The feet that stood and stand are where they were; all prints go by under the trunk with them.
void GroundPlane::carry_prints(const Feet& feet, double turned_rad) noexcept {
  Eigen::Vector3d moved_m = Eigen::Vector3d::Zero();
  int stayed = 0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (!feet[i].stands || !before_[i].stands) continue;
    moved_m += feet[i].at_m - turned(before_[i].at_m, -turned_rad);
    ++stayed;
  }
  if (stayed > 0) moved_m /= stayed;
  sunk_m_ = moved_m.z() - slope_.dot(moved_m.head<2>());
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (feet[i].stands) {
      print_m_[i] = feet[i].at_m;
      has_print_[i] = true;
    } else if (has_print_[i]) {
      print_m_[i] = turned(print_m_[i], -turned_rad) + moved_m;
    }
  }
}

/// How much of what the slope is off by has one direction, 0..1: the tracking signal of
/// facts D15.
double GroundPlane::trend(const Eigen::Vector2d& off, double period_s, double dt_s) noexcept {
  const double share = std::min(1.0, dt_s / (kTrendPeriods * period_s));
  off_ += share * (off - off_);
  off_length_ += share * (off.norm() - off_length_);
  return off_length_ > 0.0 ? std::min(1.0, off_.norm() / off_length_) : 0.0;
}

/// As a filter would whose footprints are as uncertain as the ground is rough, unless all of them say that
/// the ground begins to slope.
void GroundPlane::learn(double period_s, double dt_s) noexcept {
  const Fit found = fit();
  const double fades = std::min(1.0, dt_s / (kRoughPeriods * period_s));
  rough_m2_ = std::max(found.rough_m2, rough_m2_ + fades * (found.rough_m2 - rough_m2_));
  const double to_and_fro = 1.0 - trend(found.slope - slope_, period_s, dt_s);
  const double doubt = 1.0 + to_and_fro * to_and_fro * rough_m2_ / (kSmooth_m * kSmooth_m);
  slope_ += std::min(1.0, dt_s / (doubt * kSlopePeriods * period_s)) * (found.slope - slope_);
  newest_slope_ = slope_ + (found.slope - slope_) / doubt;
}

void GroundPlane::follow(const Feet& feet, double yaw_rad, double period_s, double dt_s) noexcept {
  const double turned_rad = wrapped_rad(yaw_rad - yaw_rad_);
  yaw_rad_ = yaw_rad;
  for (Eigen::Vector2d* slope : {&slope_, &off_})
    *slope = turned({slope->x(), slope->y(), 0.0}, -turned_rad).head<2>();
  carry_prints(feet, turned_rad);
  before_ = feet;
  z_m_ += sunk_m_;
  learn(period_s, dt_s);
  double over_m = 0.0;
  int standing = 0;
  for (const GroundFoot& foot : feet) {
    if (!foot.stands) continue;
    over_m += foot.at_m.z() - z_m(foot.at_m);
    ++standing;
  }
  if (standing == 0) return;
  const double most_m = kLearned_m_s * dt_s;
  z_m_ += std::clamp(over_m / standing, -most_m, most_m);
}

GroundPlane::Fit GroundPlane::fit() const noexcept {
  Eigen::Vector3d middle_m = Eigen::Vector3d::Zero();
  int prints = 0;
  for (std::size_t i = 0; i < print_m_.size(); ++i) {
    if (!has_print_[i]) continue;
    middle_m += print_m_[i];
    ++prints;
  }
  if (prints < 3) {
    Fit none;
    none.slope = slope_;
    none.rough_m2 = rough_m2_;
    return none;
  }
  middle_m /= prints;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Identity() * (kLeastSpread_m * kLeastSpread_m);
  Eigen::Vector2d rise = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < print_m_.size(); ++i) {
    if (!has_print_[i]) continue;
    const Eigen::Vector3d from_m = print_m_[i] - middle_m;
    spread += from_m.head<2>() * from_m.head<2>().transpose();
    rise += from_m.z() * from_m.head<2>();
  }
  Fit out;
  out.slope = spread.inverse() * rise;
  out.slope_per_m2 = spread.inverse().diagonal();
  for (std::size_t i = 0; i < print_m_.size(); ++i) {
    if (!has_print_[i]) continue;
    const Eigen::Vector3d from_m = print_m_[i] - middle_m;
    const double off_m = from_m.z() - out.slope.dot(from_m.head<2>());
    out.rough_m2 += off_m * off_m;
  }
  if (out.slope.norm() > kSteepest) out.slope *= kSteepest / out.slope.norm();
  return out;
}

Eigen::Vector2d GroundPlane::slope_bound() const noexcept {
  return kTwoSigma * std::sqrt(rough_m2_ + kFootHeight_m * kFootHeight_m) * fit().slope_per_m2.cwiseSqrt();
}

double GroundPlane::z_bound_m() const noexcept {
  return kTwoSigma * std::sqrt(rough_m2_ + kFootHeight_m * kFootHeight_m);
}

}  // namespace sprung
