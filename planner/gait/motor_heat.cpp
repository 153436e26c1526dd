#include "planner/gait/motor_heat.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kSlowest = 0.25;  // [design choice]

}  // namespace

void MotorHeat::begin(const JointState& in) noexcept {
  step(in);
  most_ = warmth_ >= kSlowFrom ? kSlowFrom : kStands;
}

void MotorHeat::step(const JointState& in) noexcept {
  warmth_ = 0.0;
  for (const EstimatedJoint& joint : in.joints) warmth_ = std::fmax(warmth_, joint.winding_share);
}

double MotorHeat::speed_share() const noexcept {
  const double over = (warmth_ - kSlowFrom) / (kStands - kSlowFrom);
  return std::clamp(1.0 - (1.0 - kSlowest) * over, kSlowest, 1.0);
}

}  // namespace sprung
