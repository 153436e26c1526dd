#pragma once
/// `sprung experiment friction_sweep`: friction of one joint from constant speeds, by the papers' protocols
/// and by one with loads, every friction model beside the others.
#include <string>
#include <vector>

#include "tools/lab/friction/friction_sweep_fit.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct SweepResult {
  SweepRecording recording;
  SweepPoints points = SweepPoints::kBoth;  ///< what the protocol's own figure is made of
  std::vector<SweepFit> fits;               ///< every model on those points, simplest first
};

/// @throws std::invalid_argument for a joint that is too short for the speeds, std::runtime_error as
/// record_sweep() does.
SweepResult run_friction_sweep(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                               int joint, SweepProtocol protocol);

/// Rows <prefix>.<quantity> of one sweep: R^2, parameters with standard errors. The papers' figures stand
/// beside their own joints: S0's 100:1, S1's 50:1, which has bounds.
std::vector<ReportRow> sweep_rows(const SweepResult& result, const std::string& prefix);

/// The rows of `sprung experiment estimator`: estimator.friction_fit.r2 on S1's protocol and
/// estimator.friction_fit_loaded.r2, held out, with the load term. @param robot S1's, with joints of 50:1.
/// @param simulated_s where not null: grows.
std::vector<ReportRow> friction_fit_rows(const RobotConfig& robot, const std::string& preset,
                                         const SimOptions& sim, double* simulated_s = nullptr);

Experiment friction_sweep_experiment();

}  // namespace sprung
