#include "planner/walk_request.h"

#include <cmath>

namespace sprung {

WalkRequest walk_request(const OperatorCommand& command, const PresetConfig& preset) noexcept {
  const bool own_height = std::isnan(command.body_height_m);
  const bool own_width = std::isnan(command.stance_width_m);
  return {command.gait, command.walk_speed, own_height ? preset.stand_length_m : command.body_height_m,
          own_width ? preset.walk.stance_width_m : command.stance_width_m, command.gait_control};
}

}  // namespace sprung
