#pragma once
/// A robot that is up, and what of it goes out to operators elsewhere: its newest states, less often than
/// they come, and its answers.
#include <cstdint>
#include <string>
#include <vector>

#include "tools/operate/launcher/run_file.h"
#include "tools/station/server/robot_link_shell.h"

namespace sprung::gateway {

class ServedRobot {
 public:
  /// @throws as load_robot() and RobotLink.
  explicit ServedRobot(const RunInfo& info);

  const RunInfo& info() const noexcept { return info_; }
  station::RobotLink& link() noexcept { return link_; }
  /// It jumps, walks, complies, or a joint moves.
  bool moves();
  /// JSON: the run, the build, and which files the robot's folder has.
  const std::string& description() const noexcept { return description_; }
  /// What is due: channel, a zero, message.
  std::vector<std::string> due(std::int64_t now_us);

 private:
  /// A channel, and how often its newest goes out.
  struct Decimated {
    station::RobotLink::Reader reader;
    std::int64_t each_us;
    std::int64_t next_us = 0;
  };
  static std::vector<Decimated> decimated_channels();
  std::string reply_text(const station::RobotAnswer& answer) const;

  RunInfo info_;
  station::RobotLink link_;
  std::string description_;
  std::vector<Decimated> decimated_ = decimated_channels();
  std::int64_t next_processes_us_ = 0;
};

}  // namespace sprung::gateway
