#pragma once
/// What planner and controller begin with in a cycle of a log: the joint state, as the estimator makes it
/// from the log's samples, or as the log has it. Pure. A stage of its own before CoreReplay, of which it
/// needs nothing: it may be cycles ahead, in another thread.
#include <cstdint>
#include <memory>
#include <optional>

#include "robots/robot_config.h"
#include "signals/joint_state.h"
#include "tools/logs/replay/log_cycles.h"

namespace sprung {

/// An input that a core had, and that the log does not have.
struct MissingInput {
  const char* core = nullptr;
  const char* channel = nullptr;
  std::int64_t seq = -1;
};

struct EstimatedCycle {
  explicit EstimatedCycle(const RobotConfig& robot) : joint_state(robot.joints.size(), robot.legs.size()) {}

  JointState joint_state;  ///< of this cycle where `known`, else unspecified
  bool known = false;
  bool made = false;  ///< by the estimator, now
  std::optional<MissingInput> missing;
};

class EstimatorReplay {
 public:
  /// @param preset of `robot`. @param runs false: the joint state is the log's. @throws std::invalid_argument
  /// as the core does.
  EstimatorReplay(const RobotConfig& robot, const std::string& preset, const WatchdogConfig& watchdogs,
                  bool runs);
  ~EstimatorReplay();
  EstimatorReplay(const EstimatorReplay&) = delete;
  EstimatorReplay& operator=(const EstimatorReplay&) = delete;

  /// Cycles in ascending order. @throws std::runtime_error on messages of another robot, or of another
  /// version of their type.
  void step(const LoggedCycle& cycle, EstimatedCycle& out);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung
