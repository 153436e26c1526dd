#pragma once
/// What somebody needs who looks at an incident afterwards, in one folder or archive. Shell: reads logs,
/// writes files, calls tar.
#include <string>
#include <vector>

#include "tools/logs/log/log_info.h"

namespace sprung::log {

inline constexpr const char* kArchiveEnding = ".tar.gz";

struct BundleRequest {
  std::string log;       ///< the last part, of a recording that was split
  double last_s = 30.0;  ///< of the robot's time, before the log's end
  std::string run_file;  ///< of the robot that is up; "" = none is
  std::string out;       ///< NAME.tar.gz, else a folder; must not be there
};

struct Bundle {
  std::vector<std::string> files;  ///< names in it
  std::string cause;               ///< one or two lines, with their ends
};

/// Whether it is to be an archive, by its name.
bool is_archive(const std::string& path);

/// A stop of safety that is older than `last_s` is looked for in the whole recording, and comes along with as
/// much of what was before it. @throws std::runtime_error naming what cannot be read or written; then nothing
/// is left behind.
Bundle write_bundle(const BundleRequest& request, const Progress& progress = {});

/// Of this program, LCM, kernel and distribution: of the machine on which it is asked.
std::string versions_text();

}  // namespace sprung::log
