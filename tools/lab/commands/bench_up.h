#pragma once
/// `sprung bench up`.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_bench_up(CommandLine& bench);

}  // namespace sprung::commands
