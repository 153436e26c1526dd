#include "tools/lab/gait/trunk_hand.h"

#include <algorithm>

namespace sprung {

std::vector<TrunkPush> trunk_pushes() {
  return {{"impulse", -300.0, 0.0, 0.05, 0.0},      {"pushdown", 0.0, -0.010, 1.0, 1.0},
          {"lift", 0.0, 0.030, 1.0, 1.0},           {"impulse_30Ns", -600.0, 0.0, 0.05, 0.0},
          {"pushdown_30mm", 0.0, -0.030, 1.0, 1.0}, {"pushforce", -150.0, 0.0, 1.0, 1.0}};
}

double TrunkHand::share(double time_s) const noexcept {
  const double up = time_s / push_.rise_s;
  const double down = (push_.length_s() - time_s) / push_.rise_s;
  return std::clamp(std::min(up, down), 0.0, 1.0);
}

double TrunkHand::step_N(double time_s, double risen_m) noexcept {
  const double speed_m_s = (risen_m - last_m_) / step_s_;
  last_m_ = risen_m;
  if (time_s >= push_.length_s()) return 0.0;
  if (push_.distance_m == 0.0) return push_.force_N * share(time_s);
  return kStiffness_N_m * (push_.distance_m * share(time_s) - risen_m) - kDamping_N_s_m * speed_m_s;
}

}  // namespace sprung
