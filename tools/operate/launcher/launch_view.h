#pragma once
/// What people see of `sprung up`: one live screen in a terminal, else plain lines on standard output and
/// error.
#include <cstdint>
#include <memory>
#include <string>

#include "tools/operate/launcher/launch_screen.h"
#include "tools/operate/launcher/launcher.h"
#include "tools/operate/launcher/terminal.h"

namespace sprung {

class LaunchView {
 public:
  /// Takes over the launcher's lines. @param plain no screen, whatever the terminal can do.
  LaunchView(Launcher& launcher, const RobotConfig& robot, bool plain);
  ~LaunchView();  ///< gives the terminal back, and says there what was last on the screen's log
  LaunchView(const LaunchView&) = delete;
  LaunchView& operator=(const LaunchView&) = delete;

  /// "starting", "up", "stopping".
  void phase(const std::string& phase);
  /// The robot is up: says so, with clock, preset and network, and what to type next.
  void announce(double ready_s);
  void turn();  ///< call it many times a second; draws when it is time

 private:
  ScreenContent content() const;
  void draw();

  Launcher& launcher_;
  const RobotConfig& robot_;
  std::string phase_ = "starting";
  LogLines lines_{1000};
  std::unique_ptr<Terminal> terminal_;
  std::int64_t begin_us_;
  std::int64_t next_draw_us_ = 0;
};

/// What to type once this robot is up.
std::string first_commands(const RobotConfig& robot, bool maintenance);

}  // namespace sprung
