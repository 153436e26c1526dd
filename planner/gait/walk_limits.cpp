#include <algorithm>
#include <cmath>

#include "planner/gait/walk.h"
#include "robots/gait_speed.h"

/// What may be asked of a walk, and what of it may change.
namespace sprung {

void Walk::adjust(const AdjustableConfig& config) noexcept {
  law_ = config.preset.walk;
  stance_friction_ = law_.stance_friction_compensation;
  standing_friction_ = std::max(stance_friction_,
                                law_.standing_friction_share * config.preset.friction_compensation);
  ramp_.limit(law_.acceleration_m_s2, law_.turning_acceleration_rad_s2);
  for (std::size_t i = 0; i < gaits_.size(); ++i) {
    for (GaitConfig* gait : {&gaits_[i], &backward_gaits_[i]}) {
      gait->lift_m = config.gaits[i].lift_m;
      gait->height_m = config.gaits[i].height_m;
      gait->fastest_forward_m_s = config.gaits[i].fastest_forward_m_s;
      gait->fastest_backward_m_s = config.gaits[i].fastest_backward_m_s;
      gait->fastest_sideways_m_s = config.gaits[i].fastest_sideways_m_s;
      gait->fastest_turning_rad_s = config.gaits[i].fastest_turning_rad_s;
    }
  }
}

WalkRequest Walk::within_limits(WalkRequest request) const noexcept {
  const GaitConfig& gait = gaits_[static_cast<std::size_t>(request.gait)];
  const double share = speed_share(gait, request.speed);
  if (share > 1.0)
    for (double& speed : request.speed) speed /= share;
  return request;
}

const char* Walk::validate(const WalkRequest& request, bool walking) const noexcept {
  if (gaits_.empty()) return "this robot has no gaits";
  if (request.gait < 0 || request.gait >= static_cast<int>(gaits_.size())) return "unknown gait";
  const GaitConfig& wanted = gaits_[request.gait];
  if (!(request.speed[0] <= wanted.fastest_forward_m_s)) return "faster forward than this gait goes";
  if (!(request.speed[0] >= -wanted.fastest_backward_m_s)) return "faster backward than this gait goes";
  if (!(std::abs(request.speed[1]) <= wanted.fastest_sideways_m_s))
    return "faster sideways than this gait goes";
  if (!(std::abs(request.speed[2]) <= wanted.fastest_turning_rad_s))
    return "faster turning than this gait goes";
  if (!(speed_share(wanted, request.speed) <= kMostSpeedShare))
    return "faster forward, sideways and turning together than this gait goes";
  const bool high = request.height_m >= kLowestShare * stand_height_m_ &&
                    request.height_m <= kHighestShare * stand_height_m_;
  if (!high) return "body height beyond 60 to 105 % of the preset's stand_length";
  if (!(request.stance_width_m >= kNarrowest_m && request.stance_width_m <= kWidest_m))
    return "stance width beyond -50 to 150 mm";
  if (walking && failure_ != nullptr) return failure_;
  if (!walking || request.gait == now_.gait) return nullptr;
  const GaitConfig& now = gaits_[now_.gait];
  const bool follows = std::find(now.to.begin(), now.to.end(), wanted.name) != now.to.end();
  return follows ? nullptr : "no transition between these gaits: stop first";
}

}  // namespace sprung
