#pragma once
/// Rows of `sprung experiment estimator` from jumps of single_leg, and from a gear that is warm.
#include <cstdint>
#include <string>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

/// estimator.pushoff.*, estimator.landing.*, estimator.landing_stiff.*: error of the gear output torque of
/// the knee, the hip's as *_hip, the landing's without its first 8 ms as .rms_after_impact, and the papers'
/// equation as *_paper; the push-off with the plant's Coulomb friction 25 % off both ways too.
/// estimator.jump.*: how the bounds hold over all of these runs.
/// @param base plant and seed: five runs each, with noise seeds 100 seed + 1 to 5; 0 was used for tuning.
void add_jump_rows(const RobotConfig& robot, const std::string& preset, const SimOptions& base,
                   ExperimentOutput& report);

/// estimator.bounds.*: share of samples of hybrid jumps (push-off, flight, landing; all joints) whose error
/// is within the stated bound, on each plant of estimator_plants(base, ensemble) and pooled; mean half-width
/// over RMS error; estimator.bounds.moving.half_width_over_rms: the same where the joint is not taken to be
/// at rest.
void add_bounds_rows(const RobotConfig& robot, const std::string& preset, const SimOptions& base,
                     std::uint64_t ensemble, ExperimentOutput& report);

/// estimator.temperature.rms_24, _37, _50: gear output torque of test_axis's arm while it swings to and fro,
/// after some swings in which the estimator may learn the temperature; .ratio: the worst of them over the
/// best. @param seed of the noise.
void add_temperature_rows(const RobotConfig& robot, const std::string& preset, std::uint64_t seed,
                          ExperimentOutput& report);

}  // namespace sprung
