#pragma once
/// A study as small as one can be, and its file.
#include <fstream>
#include <string>

#include "tools/lab/study/study_reader.h"

namespace sprung::test {

/// Step responses: a fifth of a second a run.
inline const char* const kSampleStudy =
    "study: sample\n"
    "experiment: step_response\n"
    "robot: single_leg\n"
    "parameters:\n"
    "  presets.best.torque_jump.stiffness.z: {values: [3000 N/m, 6280 N/m]}\n"
    "plants: [{}, {friction_scale: 1.2}]\n"
    "seeds: 1..2\n";

inline std::string written(const std::string& text, const std::string& path) {
  std::ofstream(path) << text;
  return path;
}

inline Study study_of(const std::string& text, const std::string& folder) {
  return read_study(written(text, folder + "/study.yaml"));
}

}  // namespace sprung::test
