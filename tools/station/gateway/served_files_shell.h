#pragma once
/// Files that the gateway gives to operators: what the run is, the robot's files, its logs. Reads them.
///
///   run          what `sprung up` has written of the run, and which files there are of the robot; JSON
///   robot/NAME   a file of the robot's folder
///   logs         which logs there are: JSON, a list of {name, size, modified}, the newest last
///   log/NAME     one of them
#include <cstdint>
#include <string>
#include <vector>

#include "tools/station/gateway/file_parts.h"

namespace sprung::gateway {

/// What is asked for first, of the file that lies there; its error says where there is none, or
/// only a link to one.
FilePart read_part(const PartRequest& request, const std::string& path);

class ServedFiles {
 public:
  /// @param log_folder may be empty: the one that the run logs to, once there was one.
  explicit ServedFiles(std::string log_folder) : log_folder_(std::move(log_folder)) {}

  /// @param log of the run; empty: it has none.
  void robot_is_up(std::string description, std::string robot_folder, const std::string& log);
  void robot_is_down() { description_.clear(); }

  /// All that are asked for, as far as the file goes; one with an error where it cannot be had.
  std::vector<FilePart> parts(const PartRequest& request, std::int64_t now_us);

 private:
  FilePart part(const PartRequest& request, std::int64_t now_us);

  std::string log_folder_, description_, robot_folder_;
  std::string list_;  ///< of the logs
  std::int64_t listed_us_ = 0;
};

}  // namespace sprung::gateway
