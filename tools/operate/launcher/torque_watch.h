#pragma once
/// Whether any drive has torque, as the bridge says cycle by cycle. The launcher looks only while a process
/// waits to be started again: DRIVE_STATE comes too often to be read all the time.
#include <optional>

#include "robots/robot_config.h"
#include "runtime/node.h"
#include "runtime/slot.h"
#include "signals/drive_state.h"
#include "tools/operate/launcher/restart_rule.h"

namespace sprung {

/// Pure: a drive of which the state is not known may have torque.
bool may_have_torque(const DriveState& state) noexcept;

class TorqueWatch {
 public:
  /// On the network and in the session of a run; times are utime_us() of `clock`.
  TorqueWatch(const NodeOptions& options, const RobotConfig& robot);
  ~TorqueWatch();
  TorqueWatch(const TorqueWatch&) = delete;
  TorqueWatch& operator=(const TorqueWatch&) = delete;

  /// The newest DRIVE_STATE; nothing as long as none has come.
  std::optional<TorqueHeard> heard() const;

 private:
  Slot<DriveState> states_;
  Node node_;
};

}  // namespace sprung
