#pragma once
/// `sprung identify --record ROBOT JOINT`: moves one joint of a running robot, or of one simulated in this
/// process, through the protocol and records it.
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/command_line.h"

namespace sprung::commands {

struct GuidedRecording {
  bool wanted = false;
  std::string robot;
  std::string joint;
  std::string file;
  std::string range;
  std::string fastest;
  double longest_pass_s = 4.0;
  double pause_s = 0.3;
  bool loaded = false;
  std::string weight;  ///< at the foot, "5kg"; empty: none
  bool suspended = false;
  bool in_process = false;
  std::uint64_t seed = 1;
  std::vector<std::string> plant;
  bool yes = false;
  std::string instance = "default";
};

/// Options and positionals of `sprung identify` that belong to it. `request` must outlive the command line.
void add_guided_recording(CommandLine& identify, GuidedRecording& request);

/// @return exit status.
int run_guided_recording(const GuidedRecording& request);

}  // namespace sprung::commands
