#include "tools/can/commission/travel_probe.h"

#include <algorithm>
#include <cmath>

namespace sprung::commission {
namespace {

constexpr double kSpeedFilter_s = 0.02;   ///< of differentiated counts [design choice]
constexpr double kDampingRatio = 0.7;     ///< of integrator and inertia
constexpr double kAtCap = 0.98;           ///< of the cap
constexpr double kProgress_rad = 0.0005;  ///< within kPatience_s, else it stands still

}  // namespace

double TravelProbe::step(double dt_s, double position_rad) noexcept {
  if (outcome_ != Travel::kGoing) return 0.0;
  watch(dt_s, position_rad);
  judge(dt_s);
  if (outcome_ != Travel::kGoing) return torque_Nm_ = 0.0;
  const double stiffness = plan_.cap_Nm / plan_.ramp_s / plan_.speed_rad_s;  // Nm / rad
  const double damping = 2.0 * kDampingRatio * std::sqrt(stiffness * plan_.inertia_kg_m2);
  const double speed_rad_s = plan_.direction * speed_rad_s_;
  integral_Nm_ = std::clamp(integral_Nm_ + stiffness * (plan_.speed_rad_s - speed_rad_s) * dt_s, 0.0,
                            plan_.cap_Nm);
  torque_Nm_ = std::clamp(integral_Nm_ - damping * speed_rad_s, 0.0, plan_.cap_Nm);
  highest_Nm_ = std::max(highest_Nm_, torque_Nm_);
  return plan_.direction * torque_Nm_;
}

void TravelProbe::watch(double dt_s, double position_rad) noexcept {
  if (!begun_) start_rad_ = last_rad_ = position_rad;
  begun_ = true;
  const double share = dt_s / (kSpeedFilter_s + dt_s);
  speed_rad_s_ += share * ((position_rad - last_rad_) / std::max(dt_s, 1e-6) - speed_rad_s_);
  last_rad_ = position_rad;
  moved_rad_ = plan_.direction * (position_rad - start_rad_);
  farthest_rad_ = std::max(farthest_rad_, std::abs(moved_rad_));
  if (breakaway_Nm_ == 0.0 && moved_rad_ > kMoved_rad) breakaway_Nm_ = torque_Nm_;
  if (moved_rad_ > 0.5 * plan_.travel_rad) {
    sliding_sum_Nm_ += plan_.direction * torque_Nm_;
    ++sliding_count_;
  }
}

void TravelProbe::judge(double dt_s) noexcept {
  const bool further = std::abs(moved_rad_ - stuck_at_rad_) > kProgress_rad;
  stuck_s_ = further || torque_Nm_ < kAtCap * plan_.cap_Nm ? 0.0 : stuck_s_ + dt_s;
  if (further) stuck_at_rad_ = moved_rad_;
  if (farthest_rad_ > plan_.bound_rad) {
    outcome_ = Travel::kTooFar;
  } else if (std::abs(speed_rad_s_) > plan_.fast_rad_s) {
    outcome_ = Travel::kTooFast;
  } else if (moved_rad_ < -kMoved_rad) {
    outcome_ = Travel::kWrongWay;
  } else if (moved_rad_ >= plan_.travel_rad) {
    outcome_ = Travel::kArrived;
  } else if (stuck_s_ > kPatience_s) {
    outcome_ = moved_rad_ > kMoved_rad ? Travel::kFades : Travel::kNoMotion;
  }
}

}  // namespace sprung::commission
