#pragma once
/// `sprung home`: finds the zero of actuators that have no power and stand still, from the link encoder, the
/// motor encoder's index pulse or the jig that the robot stands in. All or none. Goes through it over cycles.
/// Pure.
#include <cstdint>
#include <vector>

#include "drivers/bridge/drive_node.h"
#include "signals/operator.h"

namespace sprung {

class Homing {
 public:
  enum class Result : std::int8_t { kNothing, kDone, kFailed };

  explicit Homing(std::vector<DriveNode*> drives);

  /// @return nullptr when it has begun, else why not. Static text.
  const char* begin(const OperatorCommand& command, std::int64_t time_us) noexcept;
  /// Once a cycle, when the drives' answers have been judged. kDone and kFailed are told once.
  /// @param refusal why the robot as a whole may not be homed now; nullptr = it may. Static text.
  Result step(std::int64_t time_us, const char* refusal) noexcept;

  bool running() const noexcept { return running_; }
  const char* reason() const noexcept { return reason_; }  ///< why it failed. Static text.

 private:
  const char* choose(const OperatorCommand& command) noexcept;
  bool find_offset(std::size_t i, double& offset_rad) const noexcept;
  double guess_rad(const DriveNode& drive) const noexcept;

  std::vector<DriveNode*> drives_;
  std::vector<ReferenceSource> sources_;  ///< of each drive; kConfigured = it is not homed now
  std::int64_t begun_us_ = 0;
  bool running_ = false;
  const char* reason_ = "";
};

}  // namespace sprung
