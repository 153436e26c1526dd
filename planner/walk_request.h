#pragma once
/// What an operator's `walk` asks for; what it leaves open is the gait's, then the preset's. Pure.
#include "planner/gait/walk.h"
#include "signals/operator.h"

namespace sprung {

WalkRequest walk_request(const OperatorCommand& command, const PresetConfig& preset,
                         const std::vector<GaitConfig>& gaits) noexcept;

}  // namespace sprung
