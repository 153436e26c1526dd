#pragma once
/// The folder of run files: $SPRUNG_RUN_DIR, else $XDG_RUNTIME_DIR/sprung, else /tmp/sprung-UID. In the last
/// one anybody may have made that name before: what stands there is believed only where nobody else can write
/// it.
#include <filesystem>

namespace sprung {

std::filesystem::path run_folder();

/// Nobody but this user can write there, or the folder is not there. @throws std::runtime_error where it is a
/// link or no folder, is another user's, or may be written by group or others; with the command that mends
/// it.
void require_private(const std::filesystem::path& folder);

/// Makes it for this user alone, where it is not there. @throws std::runtime_error as require_private, and
/// where it cannot be made.
void make_private(const std::filesystem::path& folder);

/// run_folder(), private where it is in /tmp; others are somebody's choice, and may be a service's to read.
/// @throws std::runtime_error as require_private.
std::filesystem::path checked_run_folder();
/// The same, made where it is not there.
std::filesystem::path made_run_folder();

}  // namespace sprung
