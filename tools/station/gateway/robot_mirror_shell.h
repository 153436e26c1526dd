#pragma once
/// A robot elsewhere on an LCM network of this process's own: what the operator's link tells is said again
/// there, and commands that are heard there go into the link. With a run file, a key and the robot's files in
/// a folder of this process, to which SPRUNG_RUN_DIR leads.
#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>

#include "robots/robot_config.h"
#include "runtime/node.h"
#include "tools/operate/launcher/run_file.h"
#include "tools/station/gateway/operator_link_shell.h"

namespace sprung::gateway {

/// An OPERATOR_REPLY that was told; nullopt: it is something else, or malformed.
std::optional<sprung_msgs::operator_reply_t> reply_in(const Told& told);

class RobotMirror {
 public:
  /// @param link open; this object's alone from now on. @throws std::runtime_error where the robot's files do
  /// not arrive or are of another build; NotRunning where no robot is up.
  explicit RobotMirror(OperatorLink& link);
  ~RobotMirror();
  RobotMirror(const RobotMirror&) = delete;
  RobotMirror& operator=(const RobotMirror&) = delete;

  std::string driver() const;  ///< empty: nobody
  void ask_hand_over(const std::string& name);

 private:
  void remove();
  void describe();
  void fetch_robot(const std::string& description);
  template <class M>
  void add(const char* channel, const CountLimits& limits);
  void add_channels();
  void run();
  void say_again(const Told& told);
  void take_news(const std::string& text);
  void forward(std::int64_t now_us);
  void say_link(std::int64_t now_us);
  std::string link_text(std::int64_t now_us) const;

  OperatorLink& link_;
  std::string folder_;
  RunInfo info_;
  std::unique_ptr<RobotConfig> robot_;
  std::unique_ptr<RunFile> run_file_;
  InputQueue<sprung_msgs::operator_command_t> commands_{64};
  std::unique_ptr<Node> node_;
  std::map<std::string, std::function<void(std::string_view)>> channels_;
  std::string estop_;  ///< an emergency stop that nobody has answered yet
  std::int64_t estop_id_ = 0, next_estop_us_ = 0, next_status_us_ = 0;
  mutable std::mutex mutex_;  ///< of the rest
  std::string driver_, you_, role_, hand_over_;
  bool gone_ = false;
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace sprung::gateway
