#pragma once
/// What PROCESS_STATUS says of joints whose model does not fit the motion that was seen (model_watch.h).
#include <cstdint>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/joint_state.h"

namespace sprung {

/// "the model does not fit what moves: knee (viscous friction)"; empty: nothing was seen that contradicts
/// robot.yaml. A joint that is only doubted, as before its first motion, is not named.
std::string misfit_note(const RobotConfig& robot, const JointState& estimated);

/// Composes it only where it is another one, once a second at most: it allocates.
class MisfitNote {
 public:
  explicit MisfitNote(const RobotConfig& robot);
  /// Once a cycle. @return the note where it changed; nullptr: it did not.
  const std::string* update(const JointState& estimated);

 private:
  const RobotConfig& robot_;
  std::vector<MisfitReason> told_;
  std::int64_t next_us_ = 0;
  std::string note_;
};

}  // namespace sprung
