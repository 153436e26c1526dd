#pragma once
/// Row of `sprung experiment estimator`: does the estimate stay good when the gear is warm?
#include <cstdint>
#include <string>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

/// estimator.temperature.rms_24, _37, _50: gear output torque of test_axis's arm while it swings to and fro,
/// after some swings in which the estimator may learn the temperature; .ratio: the worst of them over the
/// best. @param seed of the noise.
void add_temperature_rows(const RobotConfig& robot, const std::string& preset, std::uint64_t seed,
                          ExperimentReport& report);

}  // namespace sprung
