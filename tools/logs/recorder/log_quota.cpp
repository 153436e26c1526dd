#include "tools/logs/recorder/log_quota.h"

#include <algorithm>
#include <filesystem>

namespace sprung {
namespace {

namespace fs = std::filesystem;

struct OldLog {
  fs::path path;
  fs::file_time_type written;
  std::uint64_t bytes = 0;
};

std::vector<OldLog> logs_of(const fs::path& folder) {
  std::vector<OldLog> out;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".lcm" || !entry.is_regular_file(error) || entry.is_symlink(error))
      continue;
    const OldLog log{entry.path(), entry.last_write_time(error), entry.file_size(error)};
    if (!error) out.push_back(log);
  }
  std::sort(out.begin(), out.end(), [](const OldLog& a, const OldLog& b) {
    return std::pair(a.written, a.path) < std::pair(b.written, b.path);
  });
  return out;
}

}  // namespace

std::vector<std::string> remove_oldest_logs(const std::string& folder, std::uint64_t most_bytes,
                                            const std::string& in_use) {
  const std::vector<OldLog> logs = logs_of(folder.empty() ? "." : folder);
  std::uint64_t bytes = 0;
  for (const OldLog& log : logs) bytes += log.bytes;
  std::vector<std::string> removed;
  std::error_code error;
  for (const OldLog& log : logs) {
    if (bytes <= most_bytes) break;
    if (fs::equivalent(log.path, in_use, error) || !fs::remove(log.path, error)) continue;
    bytes -= log.bytes;
    fs::remove(fs::path(log.path).replace_extension(".txt"), error);
    removed.push_back(log.path);
  }
  return removed;
}

}  // namespace sprung
