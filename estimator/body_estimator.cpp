#include "estimator/body_estimator.h"

#include "model/leg_kinematics.h"

namespace sprung {

BodyEstimator::BodyEstimator(const RobotConfig& robot)
    : cycle_s_(robot.cycle_s), has_imu_(robot.body.imu), feet_(robot.legs) {}

void BodyEstimator::reset() noexcept {
  imu_.reset();
  feet_.reset();
  attitude_.reset();
  motion_.reset();
}

void BodyEstimator::step(const std::vector<EstimatedLeg>& legs, const Imu* imu, std::int64_t seq, double dt_s,
                         EstimatedBody& out) noexcept {
  const ImuReading* const reading = imu_.update(has_imu_ ? imu : nullptr, seq, cycle_s_);
  feet_.update(legs, dt_s);
  attitude_.step(reading, feet_, dt_s);
  if (attitude_.known())
    motion_.step(reading, {attitude_.trunk_to_world(), attitude_.angular_velocity_rad_s()}, feet_, dt_s);
  out = EstimatedBody{};
  out.uses_imu = reading != nullptr;
  write(out);
}

void BodyEstimator::write(EstimatedBody& out) const noexcept {
  if (!attitude_.known()) return;
  const Eigen::Quaterniond& q = attitude_.trunk_to_world();
  out.estimated_quaternion_wxyz = {q.w(), q.x(), q.y(), q.z()};
  out.estimated_angular_velocity_rad_s = to_vec3(attitude_.angular_velocity_rad_s());
  if (!motion_.known()) return;
  out.estimated_velocity_m_s = to_vec3(motion_.velocity_m_s());
  out.estimated_height_m = motion_.height_m();
}

}  // namespace sprung
