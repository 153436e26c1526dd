#pragma once
/// What makes a lock-step run one that can be made again.
#include <cstdint>

namespace sprung {

/// Whether DRIVE_COMMAND(seq) was made from the messages of its own cycle: JOINT_STATE(seq) and
/// LEG_COMMAND(seq - 1). In lock-step everything else was made because somebody gave up waiting, by wall
/// time.
constexpr bool made_from_own_inputs(std::int64_t seq, std::int64_t used_joint_state_seq,
                                    std::int64_t used_leg_command_seq) noexcept {
  return used_joint_state_seq == seq && used_leg_command_seq == seq - 1;
}

/// What the process that went on without the others says in PROCESS_STATUS from then on, at the end of its
/// detail: launcher, logs and experiments know such a run by it.
inline constexpr const char* kNotDeterministicNote = "this run is not deterministic";
/// Begins what the estimator says of joints that its model does not fit, on PROCESS_STATUS.
inline constexpr const char* kMisfitNote = "the model does not fit what moves: ";

}  // namespace sprung
