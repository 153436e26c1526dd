#pragma once
/// A robot walks as sticks say: from the dead-man's press to its release, in one gait. Pure; times are the
/// session's us.
#include <cstdint>
#include <vector>

#include "robots/robot_config.h"
#include "signals/operator.h"
#include "tools/station/server/held_motion.h"
#include "tools/station/server/stick_lock.h"

namespace sprung::station {

class SteeredWalk {
 public:
  /// In the fastest gait that steps; a robot without gaits is never told to walk.
  explicit SteeredWalk(std::vector<GaitConfig> gaits);

  /// An index into the robot's gaits; of no effect where there is none, and at once where it walks.
  void use_gait(int gait) noexcept;
  int gait() const noexcept { return gait_; }  ///< -1: the robot has none that steps

  /// Appends what the planner is to be told now.
  void step(StickState state, const StickValues& sticks, std::int64_t now_us,
            std::vector<OperatorCommand>& say);
  /// A walk was refused, or its hold: it has ended. It begins anew with the dead-man's next press.
  void ended() noexcept;
  bool active() const noexcept { return held_.active(); }
  /// Of full sticks: forward m/s, left m/s, turning rad/s; each less where several ask for more than the gait
  /// goes.
  Vec3 speed(const StickValues& sticks) const noexcept;

 private:
  OperatorCommand walk(const Vec3& speed) const;

  std::vector<GaitConfig> gaits_;
  int gait_ = -1;
  HeldMotion held_;
  bool blocked_ = false;  ///< until the dead-man is let go
  int told_gait_ = -1;
  Vec3 told_{};
  std::int64_t told_us_ = 0;
};

}  // namespace sprung::station
