#pragma once
/// Two runs on one computer must not share what carries their words: a second bridge on a bus stops the first
/// robot. Pure.
#include <string>
#include <vector>

#include "tools/operate/launcher/run_file.h"

namespace sprung {

/// One sentence that names the other run, what both would use and what to do; empty where they can be up
/// together. A launcher that joined the run of another (`--host`) is no second run.
std::string why_not_beside(const RunInfo& ours, const RunInfo& other);

/// Of the first of `others` that is in the way; empty = none is.
std::string why_not_beside(const RunInfo& ours, const std::vector<RunInfo>& others);

}  // namespace sprung
