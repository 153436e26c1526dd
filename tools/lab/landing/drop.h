#pragma once
/// One landing from a fall: the leg hangs, stands in the air, is let go and told to `land`; the floor is not
/// quite where it is expected. Scored by the simulation's truth.
#include <cstdint>

#include "signals/vec3.h"
#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {

struct DropCase {
  JumpMode mode = JumpMode::kHybrid;
  double height_m = 0.3;    ///< of the standing leg's foot over the expected floor
  double surprise_s = 0.0;  ///< that leg touches this much later than expected; below 0: earlier
};

/// Uniform within +- `most_s`, by the seed.
double drawn_surprise_s(std::uint64_t seed, double most_s) noexcept;

/// Stand while hanging; then, in one cycle, let go and `land`; then stand on the floor.
RunScript drop_script(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                      const DropCase& drop);
/// The cycle of `drop_script` in which the leg is let go.
std::int64_t release_cycle(const RobotConfig& robot, const std::string& preset);

/// Hip and knee: "peak" is the worst of both, from the true touchdown until the leg stands up again.
struct DropResult {
  double peak_motor_torque_Nm = kNaN;   ///< motor side, the papers' signal
  double peak_output_torque_Nm = kNaN;  ///< truth
  double peak_hip_output_torque_Nm = kNaN;
  double touchdown_s = kNaN;          ///< true, since release
  double touchdown_speed_m_s = kNaN;  ///< of the foot, downward
  double touchdown_length_m = kNaN;   ///< of the leg
  double shortest_m = kNaN;           ///< leg's length
  bool folded = true;                 ///< knee was at its folded stop, or the leg did not stand again
};

/// Fed once a cycle. Pure.
class DropMetrics {
 public:
  /// Joints are found by name. @throws std::invalid_argument where the robot has no hip or knee.
  DropMetrics(const RobotConfig& robot, std::int64_t release_cycle);
  void add(const CycleRecord& cycle);
  DropResult result() const;

 private:
  void touch_down(const CycleRecord& cycle);
  void follow_peaks(const CycleRecord& cycle);

  std::size_t hip_;
  std::size_t knee_;
  double folded_knee_rad_;
  std::int64_t release_cycle_;
  double cycle_s_;
  double foot_height_m_ = kNaN;  ///< in the world, a cycle ago
  bool landed_ = false;
  bool over_ = false;  ///< it stands up again
  bool at_stop_ = false;
  bool stood_ = false;
  DropResult result_;
};

/// @throws std::runtime_error where a command was refused or the plant failed.
DropResult run_drop(const RunScript& script, const ScriptRunner& run, const CycleObserver& watch = {});

}  // namespace sprung
