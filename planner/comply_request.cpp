#include "planner/comply_request.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

Vec3 completed(const Vec3& asked, const Vec3& preset) noexcept {
  Vec3 out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = std::isnan(asked[i]) ? preset[i] : asked[i];
  return out;
}

bool within(const Vec3& values, double highest) noexcept {
  return std::all_of(values.begin(), values.end(), [=](double v) { return v >= 0.0 && v <= highest; });
}

bool is_open(const Vec3& asked) noexcept { return std::isnan(asked[0]) || std::isnan(asked[2]); }

}  // namespace

ComplyRequest comply_request(const OperatorCommand& command, const PresetConfig& preset) noexcept {
  ComplyRequest out;
  out.gains.stiffness_N_m = completed(command.stiffness_N_m, preset.compliance.stiffness_N_m);
  out.gains.damping_N_s_m = completed(command.damping_N_s_m, preset.compliance.damping_N_s_m);
  out.gains.velocity_feedforward = preset.compliance.velocity_feedforward;
  out.friction_compensation = std::isnan(command.friction_compensation) ? preset.friction_compensation
                                                                        : command.friction_compensation;
  return out;
}

const char* validate_comply(const OperatorCommand& command, const PresetConfig& preset) noexcept {
  const bool preset_has_none = preset.compliance.stiffness_N_m == Vec3{};
  if (preset_has_none && is_open(command.stiffness_N_m))
    return "stiffness is missing: this preset has no compliance of its own, give x and z";
  if (preset_has_none && is_open(command.damping_N_s_m))
    return "damping is missing: this preset has no compliance of its own, give x and z";
  const ComplyRequest request = comply_request(command, preset);
  if (!within(request.gains.stiffness_N_m, kStiffest_N_m)) return "stiffness must be 0 to 100000 N/m";
  if (!within(request.gains.damping_N_s_m, kMostDamping_N_s_m)) return "damping must be 0 to 10000 N s/m";
  const double friction = request.friction_compensation;
  return friction >= 0.0 && friction <= 1.0 ? nullptr : "friction compensation must be 0 to 1";
}

}  // namespace sprung
