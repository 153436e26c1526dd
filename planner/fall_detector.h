#pragma once
/// Whether a robot on legs falls or has fallen. Pure: no heap.
///
/// - It lies: tilted too far, or too low over its feet (robot.yaml's `fallen`).
/// - It will fall: it tips, and the capture point is so far beyond all feet that no step of any gait brings
///   it back. By an IMU: legs alone do not show a trunk that tips over its feet.
/// - Two neighbouring feet (front, hind, left, right) have found no ground for longer than a gait lifts them:
///   it lies on its nose or side. With an IMU only where it leans as well.
///
/// It lies by its tilt against gravity; it tips and leans by that against the ground.
#include <array>
#include <cstdint>
#include <vector>

#include "planner/gait/body_frame.h"
#include "planner/gait/body_view.h"
#include "robots/robot_config.h"
#include "signals/joint_state.h"

namespace sprung {

enum class Fall { kNone, kFalls, kLies };

class FallDetector {
 public:
  explicit FallDetector(const RobotConfig& robot);
  void adjust(const BodyConfig& body) noexcept;

  /// What was seen before counts no more.
  void begin_anew() noexcept;
  /// One cycle of a robot that ought to be upright. What is not known says nothing.
  /// @param swing_s for which its gait lifts a foot at most; below 0: it does not step, and may hang.
  /// @param along of a trunk that lies along the ground; heading is not used.
  Fall step(const JointState& in, double swing_s, const Attitude& along) noexcept;
  Fall found() const noexcept { return found_; }  ///< in the last cycle
  /// Too far over to get up from; nullptr: it may stand up.
  const char* why_not_up(const EstimatedBody& body) const noexcept;

 private:
  bool lies(const EstimatedBody& body) const noexcept;
  bool will_fall(const JointState& in, const Attitude& along, double dt_s) noexcept;
  bool unheld(const JointState& in, double swing_s, const Attitude& along, double dt_s) noexcept;

  BodyShape shape_;
  double tilt_rad_ = 0.0;
  double height_m_ = 0.0;
  bool has_body_;
  std::array<std::vector<std::size_t>, 4> neighbours_;  ///< legs: front, hind, left, right
  std::array<double, 4> unheld_s_{};
  double beyond_s_ = 0.0;
  bool used_imu_ = false;
  std::int64_t last_us_ = -1;  ///< -1: none
  Fall found_ = Fall::kNone;
};

}  // namespace sprung
