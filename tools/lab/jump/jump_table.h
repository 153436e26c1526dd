#pragma once
/// The short table that `sprung jump --report` prints of the jumps it commanded.
#include <string>
#include <vector>

#include "tools/lab/jump/jump_metrics.h"

namespace sprung {

/// One line a jump; both torque signals beside each other (errata E8).
std::string jump_table(const std::vector<JumpResult>& jumps);

}  // namespace sprung
