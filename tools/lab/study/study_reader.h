#pragma once
/// Reads and checks a STUDY.yaml (docs/studies.md). Start-up only: throws, allocates, reads files.
#include <string>

#include "tools/lab/study/study.h"

namespace sprung {

/// Everything that can be known before a run is checked: keys, ranges, experiment, options, robot, numbers at
/// both ends of their ranges, keys of plants.
/// @throws ConfigError with file, line and what was expected.
Study read_study(const std::string& path);

}  // namespace sprung
