#pragma once
/// Whether another master speaks on the robot's buses (design section 8). Our own frames never come back to
/// us, so whatever only a master sends is another's. One that commands our nodes is a fault; one that is only
/// there is named. Pure.
#include <cstdint>

#include "drivers/bridge/safety_machine.h"
#include "drivers/can/can_frame.h"
#include "robots/robot_config.h"

namespace sprung {

/// What a frame is that only a master sends.
enum class MasterFrame : std::int8_t {
  kNone,
  kHeartbeat,
  kAnswer,  ///< of a device that has the bridge's own node id
  kSync,
  kNmt,
  kSetPoint
};
const char* text(MasterFrame kind) noexcept;  ///< "SYNC"
/// Whose it may be and what to do. Static text.
const char* remedy(MasterFrame kind) noexcept;

/// @param ours the frame's id ends in the id of one of this robot's nodes on that bus. Service data (SDO) are
/// left out: tools beside the bridge read objects.
MasterFrame master_frame(const CanFrame& frame, bool ours) noexcept;

class ForeignMasterWatch {
 public:
  explicit ForeignMasterWatch(const RobotConfig& robot) : robot_(robot) {}

  void receive(int bus, const CanFrame& frame, bool ours) noexcept;
  /// One commands our nodes: since the last forget(). nullptr = none.
  const Fault* fault() const noexcept { return commands_ > 0 ? &fault_ : nullptr; }
  /// It goes on commanding: damping by set-points will not do.
  bool insists() const noexcept { return commands_ >= kInsists; }
  void forget() noexcept { commands_ = 0; }

 private:
  /// [design choice] A single frame may be a tool's; who goes on fights us for the drives.
  static constexpr std::int64_t kInsists = 3;

  const RobotConfig& robot_;
  Fault fault_;
  std::int64_t commands_ = 0;  ///< since the last forget()
};

}  // namespace sprung
