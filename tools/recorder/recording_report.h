#pragma once
/// What a recorder says when it has ended. Pure.
#include <string>

#include "tools/recorder/recording.h"

namespace sprung {

/// Lines of text: files, reason, and by channel how many messages came and how many cycles are missing.
/// @param longest_queue messages that waited for the disk at once.
std::string recording_report(const Recording& recording, std::size_t longest_queue);

}  // namespace sprung
