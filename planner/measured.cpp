#include "planner/measured.h"

#include <algorithm>
#include <cmath>

namespace sprung {

bool all_enabled(const JointState& in) noexcept {
  return std::all_of(in.joints.begin(), in.joints.end(),
                     [](const EstimatedJoint& j) { return j.drive_enabled; });
}

bool all_settled(const JointState& in) noexcept {
  return std::none_of(in.joints.begin(), in.joints.end(),
                      [](const EstimatedJoint& j) { return j.status == JointStatus::kStarting; });
}

bool any_fault(const JointState& in) noexcept {
  return std::any_of(in.joints.begin(), in.joints.end(),
                     [](const EstimatedJoint& j) { return j.status == JointStatus::kFault; });
}

bool any_contact(const JointState& in) noexcept {
  return std::any_of(in.legs.begin(), in.legs.end(), [](const EstimatedLeg& l) { return l.contact; });
}

double longest_leg_m(const JointState& in) noexcept {
  double length_m = 0.0;
  for (const EstimatedLeg& leg : in.legs) length_m = std::max(length_m, -leg.estimated_foot_in_hip_m[2]);
  return length_m;
}

}  // namespace sprung
