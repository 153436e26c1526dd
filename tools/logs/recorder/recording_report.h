#pragma once
/// What a recorder says when it has ended. Pure.
#include <string>

#include "tools/logs/recorder/recording.h"

namespace sprung {

/// Lines of text: files, reason, how many messages came, and for each channel with gaps or repeats how many.
/// @param longest_queue messages that waited for the disk at once.
std::string recording_report(const Recording& recording, std::size_t longest_queue);

}  // namespace sprung
