#pragma once
/// The live page's end of a robot's LCM network: an ordinary operator with the run's key. Keeps the newest of
/// what it hears; only answers are kept in a row.
#include <cstdint>
#include <mutex>
#include <optional>
#include <vector>

#include "robots/robot_config.h"
#include "runtime/node.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/operator.h"
#include "tools/operate/client/status_report.h"
#include "tools/operate/launcher/run_file.h"
#include "tools/station/server/request_desk.h"

namespace sprung::station {

class RobotLink {
 public:
  /// Listens from here on. @throws std::runtime_error where key or network cannot be had, saying what to do.
  RobotLink(const RunInfo& info, const RobotConfig& robot);
  ~RobotLink() { node_.stop(); }
  RobotLink(const RobotLink&) = delete;
  RobotLink& operator=(const RobotLink&) = delete;

  std::int64_t utime_us() const noexcept { return node_.utime_us(); }
  /// Stamped with now: a command that is said again is a new message.
  void say(OperatorCommand command);

  std::vector<RobotAnswer> take_answers();
  /// The newest; false as long as there is none.
  bool drives(DriveState& out) const { return drives_.newest(out); }
  bool joints(JointState& out) const { return joints_.newest(out); }
  /// What `sprung status` tells, of now.
  const HeardRobot& hear();
  std::int64_t refused_messages() const { return node_.refused_messages(); }

 private:
  /// One message that a newer one replaces.
  template <class M>
  struct Box {
    std::mutex mutex;
    std::optional<M> message;
    void put(const M& next) {
      const std::lock_guard<std::mutex> lock(mutex);
      message = next;
    }
    void take_to(Newest<M>& newest, std::int64_t now_us) {
      const std::lock_guard<std::mutex> lock(mutex);
      if (message) newest.take(std::move(*message), now_us);
      message.reset();
    }
  };

  std::int64_t session_;
  Slot<DriveState> drives_;
  Slot<JointState> joints_;
  Box<sprung_msgs::motion_state_t> motions_;
  Box<sprung_msgs::safety_state_t> safeties_;
  Box<sprung_msgs::bus_state_t> buses_;
  InputQueue<sprung_msgs::process_status_t> processes_{256};
  InputQueue<sprung_msgs::operator_reply_t> replies_{256};
  HeardRobot heard_;
  JointState newest_joints_;
  Node node_;
  Publisher<OperatorCommand> commands_;
};

}  // namespace sprung::station
