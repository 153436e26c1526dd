#pragma once
#include "runtime/command_line.h"

namespace sprung::commands {

/// `sprung bench inprocess`.
void add_bench_inprocess(CommandLine& bench);

}  // namespace sprung::commands
