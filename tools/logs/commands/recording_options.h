#pragma once
/// What `sprung up` and `sprung record` say to the recorder, in the same words.
#include <string>

#include "runtime/command_line.h"
#include "tools/operate/launcher/launch_plan.h"

namespace sprung::commands {

/// --with, --channels, --split-mb, --split-min, --min-free-mb, --keep-mb.
void add_recording_options(CommandLine& command, std::string& recorder, RecordingRequest& recording);

}  // namespace sprung::commands
