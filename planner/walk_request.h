#pragma once
/// What an operator's `walk` asks for; what it leaves open is the preset's. Pure.
#include "planner/gait/walk.h"

namespace sprung {

WalkRequest walk_request(const OperatorCommand& command, const PresetConfig& preset) noexcept;

}  // namespace sprung
