#include "tools/station/server/steered_walk.h"

#include <algorithm>
#include <cmath>

#include "robots/gait_speed.h"

namespace sprung::station {
namespace {

constexpr std::int64_t kTellAgain_us = 50'000;  // [design choice] speeds are ramped by the planner anyway
constexpr double kOtherSpeed = 1e-3;            // m/s, rad/s

bool differs(const Vec3& a, const Vec3& b) noexcept {
  for (std::size_t i = 0; i < 3; ++i)
    if (std::abs(a[i] - b[i]) > kOtherSpeed) return true;
  return false;
}

int fastest_that_steps(const std::vector<GaitConfig>& gaits) noexcept {
  int best = -1;
  for (std::size_t i = 0; i < gaits.size(); ++i) {
    const bool faster = best < 0 || gaits[i].fastest_forward_m_s > gaits[best].fastest_forward_m_s;
    if (gaits[i].duty < 1.0 && faster) best = static_cast<int>(i);
  }
  return best;
}

}  // namespace

SteeredWalk::SteeredWalk(std::vector<GaitConfig> gaits)
    : gaits_(std::move(gaits)), gait_(fastest_that_steps(gaits_)) {}

void SteeredWalk::use_gait(int gait) noexcept {
  if (gait >= 0 && gait < static_cast<int>(gaits_.size()) && gaits_[gait].duty < 1.0) gait_ = gait;
}

Vec3 SteeredWalk::speed(const StickValues& sticks) const noexcept {
  if (gait_ < 0) return {};
  const GaitConfig& gait = gaits_[gait_];
  Vec3 wished{sticks.forward * fastest_along_m_s(gait, sticks.forward),
              sticks.left * gait.fastest_sideways_m_s, sticks.turning * gait.fastest_turning_rad_s};
  const double share = speed_share(gait, wished);
  for (double& each : wished) each /= std::max(1.0, share);
  return wished;
}

OperatorCommand SteeredWalk::walk(const Vec3& speed) const {
  OperatorCommand command;
  command.kind = OperatorKind::kWalk;
  command.gait = gait_;
  command.walk_speed = speed;
  command.hold_s = HeldMotion::kHold_s;
  return command;
}

void SteeredWalk::ended() noexcept {
  held_.forget();
  blocked_ = true;
}

void SteeredWalk::step(StickState state, const StickValues& sticks, std::int64_t now_us,
                       std::vector<OperatorCommand>& say) {
  const bool driving = state == StickState::kDriving && gait_ >= 0;
  if (!driving) {
    blocked_ = false;
    held_.let_go(now_us);
  } else if (!blocked_) {
    const Vec3 wished = speed(sticks);
    const bool begins = !held_.active();
    const bool other = gait_ != told_gait_ || differs(wished, told_);
    if (begins || (other && now_us - told_us_ >= kTellAgain_us)) {
      say.push_back(walk(wished));
      if (begins) held_.begin(now_us);
      told_ = wished;
      told_gait_ = gait_;
      told_us_ = now_us;
      held_.renewed(now_us);
    }
    held_.touch(now_us);
  }
  held_.step(now_us, say);
}

}  // namespace sprung::station
