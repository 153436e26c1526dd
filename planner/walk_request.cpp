#include "planner/walk_request.h"

#include <cmath>

namespace sprung {
namespace {

double default_height_m(int gait, const PresetConfig& preset, const std::vector<GaitConfig>& gaits) noexcept {
  const bool known = gait >= 0 && gait < static_cast<int>(gaits.size());
  const double height_m = known ? gaits[gait].height_m : 0.0;
  return height_m > 0.0 ? height_m : preset.stand_length_m;
}

}  // namespace

WalkRequest walk_request(const OperatorCommand& command, const PresetConfig& preset,
                         const std::vector<GaitConfig>& gaits) noexcept {
  const double height_m = std::isnan(command.body_height_m) ? default_height_m(command.gait, preset, gaits)
                                                            : command.body_height_m;
  const double width_m = std::isnan(command.stance_width_m) ? preset.walk.stance_width_m
                                                            : command.stance_width_m;
  return {command.gait, command.walk_speed, height_m, width_m, command.gait_control};
}

}  // namespace sprung
