#pragma once
/// What a cycle of the whole stack costs in one process, part by part: `sprung bench inprocess`.
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

/// Rows inprocess.<robot>.*, of a robot in its fastest gait at half of its speed, on the flat floor:
///   realtime_factor        simulated time over processor time of the one thread
///   simulation, bridge, estimator, planner, controller (_cycle)
///                          median of a cycle, us, and its ratio to the reference loop
///   cores_cycle            estimator, planner and controller without the force distribution, by the medians
///   cores_processor_mean, _p9999
///                          processor time of this thread for all three, force distribution included; of
///                          10,000 cycles (20 s) or fewer the latter is the worst
///   force_distribution     one call, two feet standing (a trot) and four, as above
///   simulation_over_mj_step, stack_over_mj_step
///                          speed against bare mj_step of the same model and step, standing
/// @throws std::invalid_argument for a robot without gaits, std::runtime_error where it does not stand up or
/// walk.
std::vector<ReportRow> bench_stack(const RobotConfig& robot, double seconds);

}  // namespace sprung
