#pragma once
/// Rows of `sprung experiment estimator` that come from jumps of single_leg.
#include <cstdint>
#include <string>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

/// Noise of sim.yaml, and this jitter of the instant at which an encoder is read.
inline constexpr double kScoredJitter_us = 2.0;

/// estimator.pushoff.*, estimator.landing.*, estimator.landing_stiff.*: error of the gear output torque of
/// the knee, the hip's as *_hip, and the papers' equation as *_paper; the push-off with the plant's Coulomb
/// friction 25 % off both ways too.
/// @param seed five runs each, with noise seeds 100 seed + 1 to 5; 0 was used for tuning.
void add_jump_rows(const RobotConfig& robot, const std::string& preset, std::uint64_t seed,
                   ExperimentReport& report);

/// estimator.bounds.*: share of samples of hybrid jumps (push-off, flight, landing; all joints) whose error
/// is within the stated bound, on each plant of estimator_ensemble(seed) and pooled; mean half-width over RMS
/// error.
void add_bounds_rows(const RobotConfig& robot, const std::string& preset, std::uint64_t seed,
                     ExperimentReport& report);

}  // namespace sprung
