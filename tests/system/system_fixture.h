#pragma once
/// Real processes for tests: own run folder, LCM port and CAN port each time, so that two runs on one machine
/// never meet.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/stall_watch.h"
#include "tools/operate/launcher/child_process.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {

struct CommandResult {
  int status = -1;
  std::string output;  ///< standard output and error together
};

class SystemTest : public testing::Test {
 protected:
  /// Nothing takes so long; what waits for it ends at once when it has come.
  static constexpr double kTimeout_s = 60.0;

  void SetUp() override;
  void TearDown() override;  ///< ends what still runs; fails when a process was left behind

  /// `sprung ARGUMENTS` to its end.
  CommandResult sprung(const std::string& arguments) const;
  /// `sprung up ROBOT --sim ...` of robot_ in the background, until the robot is up.
  void up(const std::string& clock, const std::string& more = "");
  /// Waits for `sprung up` to end by itself or after a signal.
  int wait_for_up(double timeout_s = kTimeout_s);
  ChildProcess& up_process() { return *up_; }

  /// Whether every process of the run is gone within that time.
  bool all_end(double timeout_s) const;

  RunInfo info() const;
  void kill_program(const std::string& program) const;
  /// Whether the file comes to be longer than that: a process that writes it has begun, however busy the
  /// machine is.
  static bool grows(const std::filesystem::path& file, std::uintmax_t bytes);
  std::string can_address() const { return can_address_; }  ///< of the robot's first bus
  std::string lcm_url() const { return lcm_url_; }
  /// The longest stall of this machine since up("realtime"), ms; 0 in lock-step.
  double longest_stall_ms() const { return stalls_ ? stalls_->longest_ms() : 0.0; }
  /// Two stalls as long as this one stop a healthy robot: what the watchdogs are for.
  bool machine_stalled() const {
    return 2.0 * longest_stall_ms() > 1e3 * robot_.simulation_watchdogs.command_hold_s;
  }
  /// What up() has said so far.
  std::string said() const;

  const test::OwnFolder own_folder_{"system"};
  const std::filesystem::path folder_ = own_folder_.path();
  RobotConfig robot_ = load_robot("single_leg");  ///< another one: before up()
  std::string typed_robot_;                       ///< for `sprung up`, before up(); empty = robot_'s name
  std::filesystem::path log_folder_;              ///< a log is written where one is named, before up()

 private:
  std::string can_options() const;
  std::string can_address_;
  std::string lcm_url_;
  std::vector<RunningProcess> started_;
  std::unique_ptr<ChildProcess> up_;
  std::unique_ptr<StallWatch> stalls_;
};

}  // namespace sprung
