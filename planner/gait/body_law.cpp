#include "planner/gait/body_law.h"

#include "model/leg_kinematics.h"

namespace sprung {

BodyWrench wanted_wrench(const WalkConfig& law, const BodyShape& shape, const BodyView& view,
                         const BodyWish& wish) noexcept {
  BodyWrench out;
  const Eigen::Vector3d error_m_s = view.velocity_known
                                        ? Eigen::Vector3d(wish.velocity_m_s - view.velocity_m_s)
                                        : Eigen::Vector3d::Zero();
  out.force_N = {law.speed_damping[0] * error_m_s.x(), law.speed_damping[1] * error_m_s.y(),
                 shape.mass_kg * kGravity_m_s2 + law.body_stiffness[2] * (wish.height_m - wish.height_now_m) +
                     law.body_damping[2] * error_m_s.z()};
  const Eigen::Vector3d& turning = view.angular_velocity_rad_s;
  const double roll_rad = wish.attitude.roll_rad - view.attitude.roll_rad;
  const double pitch_rad = wish.attitude.pitch_rad - view.attitude.pitch_rad;
  out.torque_Nm = {law.body_stiffness[0] * roll_rad - law.body_damping[0] * turning.x(),
                   law.body_stiffness[1] * pitch_rad - law.body_damping[1] * turning.y(), 0.0};
  return out;
}

void Lean::follow(const Eigen::Vector2d& wanted_m, double settle_s, double dt_s) noexcept {
  /// Of a step through three equal poles: (1 + x + x^2 / 2) exp(-x) = 0.1.
  constexpr double kNineTenths = 5.32;
  const double w = kNineTenths / settle_s;
  const Eigen::Vector2d pull = w * (w * (wanted_m - at_m_) - 3.0 * speed_m_s_);
  acceleration_m_s2_ += dt_s * w * (pull - 3.0 * acceleration_m_s2_);
  speed_m_s_ += dt_s * acceleration_m_s2_;
  at_m_ += dt_s * speed_m_s_;
}

}  // namespace sprung
