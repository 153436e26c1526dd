#pragma once
/// A jump cycle by cycle, for plots: from shortly before the thrust until the landing is over. Pure.
#include <vector>

#include "robots/robot_config.h"
#include "signals/vec3.h"
#include "tools/operate/client/cycle_record.h"

namespace sprung {

struct JumpSample {
  double time_s;       ///< from the start of the thrust
  double desired_y_m;  ///< of the foot in the hip's frame, up, as in S0's figures
  double y_m;          ///< the same, truth
  double hip_m;        ///< in the world
  double ground_N;     ///< vertical, truth
  double hip_motor_side_Nm;
  double hip_output_Nm;  ///< truth
  double knee_motor_side_Nm;
  double knee_output_Nm;
  MotionPhase phase;
};

/// Keeps the first jump alone.
class JumpTrace {
 public:
  static constexpr double kBefore_s = 0.05;
  static constexpr double kAfter_s = 1.0;

  /// The first two joints are hip and knee. @throws std::invalid_argument for a robot with fewer.
  explicit JumpTrace(const RobotConfig& robot);
  void add(const CycleRecord& cycle);
  const std::vector<JumpSample>& samples() const { return samples_; }

 private:
  void drop_early();

  std::vector<JumpSample> samples_;  ///< times in message time until the thrust begins
  double thrust_s_ = kNaN;
};

}  // namespace sprung
