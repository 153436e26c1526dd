#pragma once
/// `sprung experiment odometry`: a robot walks a figure of eight and says where it is.
#include "tools/lab/run/experiment.h"

namespace sprung {

Experiment odometry_experiment();

}  // namespace sprung
