#include "planner/gait/payload_estimator.h"

#include <algorithm>
#include <cmath>

#include "model/leg_kinematics.h"

namespace sprung {
namespace {

constexpr double kShortestWeighing_s = 0.3, kLongestWeighing_s = 12.0;
/// Of robot.yaml's mass: [design choice] less on its feet is a robot that hangs or lies, more no payload.
constexpr double kLightest = 0.6, kHeaviest = 2.0;
constexpr double kFarthestShift_m = 0.12;  // [design choice] that a payload moves the centre of mass
/// What of a force's bound is left where joints went both ways: all but the friction's part. On draws 1001 to
/// 1020 of pegasus at most 1.7 kg of 7.5 in a crawl, 3.2 in a trot.
constexpr double kBothWays = 0.35;
constexpr double kNewShare = 0.4;  // of a period's weight that is believed

}  // namespace

void PayloadEstimator::forget() noexcept {
  known_ = false;
  begin_anew();
}

void PayloadEstimator::add(const JointState& in, const BodyView& view) noexcept {
  if (!(in.body.estimated_height_m > least_height_m_) || !view.velocity_known) return;
  const double dt_s = 1e-6 * static_cast<double>(in.stamp.utime_us - window_.last_us);
  window_.last_us = in.stamp.utime_us;
  window_.ends_m_s = view.velocity_m_s;
  if (window_.time_s <= 0.0) window_.began_m_s = window_.ends_m_s;
  // The first cycle after a beginning has none before it.
  constexpr double kGap_s = 0.1;
  if (!(dt_s > 0.0 && dt_s < kGap_s)) return;
  window_.time_s += dt_s;
  double bound_N2 = 0.0;
  for (std::size_t i = 0; i < shape_.legs; ++i) {
    const Eigen::Vector3d force_N = view.level_from_trunk * to_eigen(in.legs[i].foot_force_N);
    window_.impulse_Ns += dt_s * force_N.z();
    window_.moment_Nms += dt_s * force_N.z() * view.foot_m[i].head<2>();
    bound_N2 += in.legs[i].foot_force_bound_N[2] * in.legs[i].foot_force_bound_N[2];
  }
  window_.bound_Ns += dt_s * std::sqrt(bound_N2);
  const Eigen::Vector3d com_m = view.level_from_trunk * shape_.com_in_trunk_m(in);
  window_.com_ms += dt_s * com_m.head<2>();
  window_.height_ms += dt_s * (in.body.estimated_height_m + com_m.z());
}

/// The mean force is m (g + change of speed / time); speed gained along the ground pulls the centre of mass
/// ahead of the middle of pressure.
bool PayloadEstimator::weigh(Weight& out) const noexcept {
  const Window& w = window_;
  if (!(w.time_s >= kShortestWeighing_s && w.time_s <= kLongestWeighing_s)) return false;
  const Eigen::Vector3d gained_m_s2 = (w.ends_m_s - w.began_m_s) / w.time_s;
  const double pull_m_s2 = kGravity_m_s2 + gained_m_s2.z();
  out.mass_kg = w.impulse_Ns / (w.time_s * pull_m_s2);
  out.bound_kg = w.bound_Ns / (w.time_s * pull_m_s2);
  out.com_m = w.com_ms / w.time_s;
  out.com_shift_m = w.moment_Nms / w.impulse_Ns - out.com_m +
                    w.height_ms / w.time_s / pull_m_s2 * gained_m_s2.head<2>();
  const bool on_its_feet = out.mass_kg > kLightest * shape_.mass_kg &&
                           out.mass_kg < kHeaviest * shape_.mass_kg;
  return on_its_feet && std::isfinite(out.bound_kg) && out.com_shift_m.norm() < kFarthestShift_m;
}

bool PayloadEstimator::rise_ended() noexcept {
  Weight found;
  known_ = weigh(found);
  begin_anew();
  if (known_) now_ = found;
  return known_;
}

bool PayloadEstimator::period_ended() noexcept {
  Weight found;
  const bool good = weigh(found);
  begin_anew();
  if (!good) return false;
  found.bound_kg *= kBothWays;
  // One period knows the mass better than a rise does, and the shift as well.
  const double mass_share = known_ && now_.bound_kg < 1.2 * found.bound_kg ? kNewShare : 1.0;
  now_.mass_kg += mass_share * (found.mass_kg - now_.mass_kg);
  now_.bound_kg = found.bound_kg;
  now_.com_m = found.com_m;
  now_.com_shift_m += (known_ ? kNewShare : 1.0) * (found.com_shift_m - now_.com_shift_m);
  known_ = true;
  return true;
}

EstimatedPayload PayloadEstimator::estimate() const noexcept {
  EstimatedPayload out;
  if (!known_) return out;
  out.mass_kg = now_.mass_kg - shape_.mass_kg;
  out.mass_bound_kg = now_.bound_kg;
  if (!(out.mass_kg > out.mass_bound_kg)) return out;
  const Eigen::Vector2d at_m = now_.com_m + now_.com_shift_m * (now_.mass_kg / out.mass_kg);
  out.in_trunk_m = {at_m.x(), at_m.y()};
  return out;
}

LoadOnTrunk PayloadEstimator::used() const noexcept {
  if (!known_) return {};
  const double payload_kg = now_.mass_kg - shape_.mass_kg;
  const double beyond_kg = std::max(0.0, std::abs(payload_kg) - now_.bound_kg);
  return {std::copysign(beyond_kg, payload_kg), now_.com_shift_m};
}

}  // namespace sprung
