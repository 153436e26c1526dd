#pragma once
/// Files that are their owner's alone: keys, and who may do what. Reads and writes files.
#include <string>

namespace sprung {

/// What a file may let others than its owner do.
enum class Others { kMayNothing, kMayRead };

/// Why a file that is open is not to be trusted; empty where it is: a plain file of this user (root trusts
/// anybody's) that lets others do no more than that.
std::string why_not_private(int fd, const std::string& path, Others others);

/// @throws std::runtime_error naming the file and the remedy where it cannot be read, is a link, or is not
/// private.
std::string read_private_file(const std::string& path, Others others);
/// Whole or not at all, in place of what stands there; with its folder. @throws std::runtime_error
void write_private_file(const std::string& path, const std::string& text);
/// The same, but not where something stands already. @throws std::runtime_error then too.
void make_private_file(const std::string& path, const std::string& text);

/// What outlives a run: $SPRUNG_STATE_DIR, else ~/.local/state/sprung; empty where neither is set.
std::string state_folder();

}  // namespace sprung
