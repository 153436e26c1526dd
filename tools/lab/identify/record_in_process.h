#pragma once
/// The guided procedure on a simulated robot in this process: for tests and experiments, as fast as the
/// machine computes.
#include <cstdint>
#include <vector>

#include "signals/drive_state.h"
#include "simulation/sim_core.h"
#include "tools/lab/identify/record_protocol.h"
#include "tools/operate/client/cycle_record.h"

namespace sprung::identify {

struct JointRecording {
  std::vector<DriveState> states;  ///< of every cycle, from the first move on until the joint is back
  std::vector<RecordMove> moves;
  std::vector<std::int64_t> began_at_seq;  ///< cycle in which each of them took effect
};

/// Drives without a reference are homed first. A robot that stands on feet hangs free (`--plant suspended`,
/// unless `sim` says how high). @param watch sees every cycle from the first move on; may be empty.
/// @throws std::runtime_error when the robot does not do what it is told; std::invalid_argument as
/// record_range().
JointRecording record_in_process(const RobotConfig& robot, const SimOptions& sim, int joint,
                                 const RecordOptions& options = {}, const CycleObserver& watch = {});

/// Of the base above the floor, so that its straight legs end 0.1 m above it. 0 for a robot whose links are
/// not known.
double hanging_height_m(const RobotConfig& robot);

}  // namespace sprung::identify
