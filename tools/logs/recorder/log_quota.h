#pragma once
/// How much of a disk the logs of a folder may take: the oldest go first. Looks at files and removes them.
#include <cstdint>
#include <string>
#include <vector>

namespace sprung {

/// Removes the oldest LCM logs of the folder, each with what was said beside it (x.lcm, x.txt), until all
/// that are left take no more than that. @param in_use a log that is being written: it stays, and counts.
/// @return the logs that were removed; one that cannot be removed is passed over.
std::vector<std::string> remove_oldest_logs(const std::string& folder, std::uint64_t most_bytes,
                                            const std::string& in_use);

}  // namespace sprung
