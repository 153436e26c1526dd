#pragma once
/// Joints as such: one moves, all others hold still. Needs no kinematics. Pure: no heap after construction,
/// never throws after it.
#include <cstdint>
#include <vector>

#include "planner/joint_limits.h"
#include "planner/joint_move.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/vec3.h"

namespace sprung {

struct JointRequest {
  int joint = -1;  ///< index into RobotConfig::joints
  double target_rad = kNaN;
  double speed_rad_s = kNaN;
  double acceleration_rad_s2 = kNaN;
};

class JointMotion {
 public:
  /// @throws std::invalid_argument as joint_limits().
  explicit JointMotion(const RobotConfig& robot);

  /// Why this cannot be done, static text; nullptr: it can.
  const char* validate(const JointRequest& request) const noexcept;

  /// Every joint stays where it was measured; nothing moves. @return false where one was not measured.
  bool hold(const JointState& in) noexcept;
  /// From where the joint shall be now. Only when validate() found nothing, and while none moves.
  void begin(const JointRequest& request, std::int64_t now_us) noexcept;
  /// Whatever moves comes to rest with the acceleration that it was begun with.
  void brake(std::int64_t now_us) noexcept;
  bool at_rest(std::int64_t now_us) const noexcept;

  /// Mode and angles of a leg, by its index.
  void write(std::size_t leg, std::int64_t now_us, DesiredLeg& out) const noexcept;

 private:
  double since_begin_s(std::int64_t now_us) const noexcept {
    return 1e-6 * static_cast<double>(now_us - began_us_);
  }

  std::vector<JointLimits> limits_;
  std::vector<std::vector<int>> legs_;  ///< their joints
  bool fits_message_ = true;            ///< LEG_COMMAND has room for every leg's joints
  std::vector<double> held_rad_;        ///< of each joint, but for the one that moves
  int moving_ = -1;                     ///< -1: none was moved yet
  JointMove move_;
  std::int64_t began_us_ = 0;
};

}  // namespace sprung
