#pragma once
/// sprung bench log.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_bench_log(CommandLine& bench);

}  // namespace sprung::commands
