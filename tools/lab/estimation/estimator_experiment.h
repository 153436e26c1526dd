#pragma once
/// `sprung experiment estimator`: the overall table of what the estimate is worth, against truth and
/// recordings. test_axis: the whole table, with the robots that it needs; another: the rows that it gives.
#include "tools/lab/run/experiment.h"

namespace sprung {

Experiment estimator_experiment();

}  // namespace sprung
