#pragma once
#include "runtime/command_line.h"

namespace sprung::commands {

/// bench replay, bench recorder
void add_bench_recording(CommandLine& bench);

}  // namespace sprung::commands
