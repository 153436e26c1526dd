#include "planner/gait/expected_ground.h"

#include <algorithm>

namespace sprung {
namespace {

constexpr double kLearned_m_s = 0.1;  // 20 mm in half a swing of a trot

}  // namespace

void ExpectedGround::begin(double z_m) noexcept {
  z_m_ = z_m;
  sunk_m_ = 0.0;
  before_ = {};
}

void ExpectedGround::follow(const std::array<GroundFoot, kMostLegs>& feet, double dt_s) noexcept {
  double sum_m = 0.0, sunk_m = 0.0;
  int standing = 0, stayed = 0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (!feet[i].stands) continue;
    sum_m += feet[i].z_m;
    ++standing;
    if (!before_[i].stands) continue;
    sunk_m += feet[i].z_m - before_[i].z_m;
    ++stayed;
  }
  before_ = feet;
  sunk_m_ = stayed > 0 ? sunk_m / stayed : 0.0;
  z_m_ += sunk_m_;
  if (standing == 0) return;
  const double most_m = kLearned_m_s * dt_s;
  z_m_ += std::clamp(sum_m / standing - z_m_, -most_m, most_m);
}

}  // namespace sprung
