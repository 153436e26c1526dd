#pragma once
/// External torque on a joint that holds its pose: what the motor gives changes, the joint does not move.
/// Pure.
///
/// The motor's torque is load + external torque's opposite + friction, and at rest friction may be anything
/// between minus and plus breakaway. So a change is known to within twice that, whatever friction was before;
/// it is certain where it is larger.
#include <vector>

#include "estimator/identification/dataset.h"

namespace sprung::identification {

struct HeldPoseOptions {
  double quiet_s = 1.5;     ///< at the beginning nobody pushes: the pose's own torque is the median there
  double breakaway = 0.0;   ///< friction at rest, in the unit of the measured torque, >= 0
  double least_s = 0.1;     ///< shorter changes are no push
  double moved_rad = 5e-3;  ///< a joint that strays further from its first position does not hold its pose
};

struct Push {
  double from_s = 0.0;
  double to_s = 0.0;      ///< where the change is below breakaway again
  double external = 0.0;  ///< largest external torque; positive pushes toward +q; unit of the measured torque
  double bound = 0.0;     ///< how wrong that may be: twice the breakaway torque, and noise
  bool certain = false;   ///< |external| > bound: not even friction that changed sides explains it
};

struct HeldPose {
  double torque = 0.0;       ///< of the pose without anybody pushing
  double noise = 0.0;        ///< standard deviation (robust) in the quiet part
  double strayed_rad = 0.0;  ///< furthest from the first position
  std::vector<Push> pushes;
};

/// @throws std::invalid_argument when the joint moves, or the quiet part holds no samples.
HeldPose find_pushes(const JointDataset& data, const HeldPoseOptions& options);

}  // namespace sprung::identification
