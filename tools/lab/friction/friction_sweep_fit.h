#pragma once
/// Friction models fitted to a sweep, each with its score on friction alone. Pure.
#include <memory>
#include <string>
#include <vector>

#include "estimator/identification/fit_statistics.h"
#include "signals/enumeration.h"
#include "tools/lab/friction/friction_sweep_bench.h"
#include "tools/lab/friction/friction_sweep_model.h"

namespace sprung {

/// What of a recording is fitted: half of R^2's dependence on the protocol.
enum class SweepPoints {
  kForward,       ///< every sample of the passes with positive speed
  kBoth,          ///< every sample
  kForwardMeans,  ///< the mean of each pass with positive speed
  kMagnitudes,    ///< S0's: half the difference between there and back, one point for both
};
constexpr auto words_of(SweepPoints) {
  return words<SweepPoints>({
      {SweepPoints::kForward, "single samples, one direction"},
      {SweepPoints::kBoth, "single samples, both directions"},
      {SweepPoints::kForwardMeans, "mean of each pass, one direction"},
      {SweepPoints::kMagnitudes, "half the difference of both directions' means"},
  });
}

/// One piece for each pass (or pair of passes).
std::vector<identification::FitPiece> sweep_pieces(const SweepRecording& recording, SweepPoints points);

/// Friction at one constant speed.
struct FrictionPoint {
  double velocity_rad_s = 0.0;
  double load_Nm = 0.0;
  double measured_Nm = 0.0;  ///< motor torque minus load: T_f of S1 (4)
  double fitted_Nm = 0.0;
};

struct SweepFit {
  std::shared_ptr<const SweepModel> model;
  identification::Fit fit;
  identification::FitStatistics statistics;
  identification::FitScore
      score;  ///< of friction, not of the motor torque: load and weight are taken off before the variance
  /// The same on passes marked as held out, by a fit to the others; of SweepPoints::kBoth alone, else 0
  /// samples.
  identification::FitScore held_out;
  std::vector<FrictionPoint> points;
};

/// Coulomb; + viscous; + Stribeck (S1 equation 5); + asymmetry where both directions are there; + load where
/// the loads differ; both.
std::vector<identification::JointTerms> sweep_models(const SweepRecording& recording, SweepPoints points);

/// Plain least squares, as S1's. @throws std::invalid_argument on a recording without passes.
SweepFit fit_sweep(const SweepRecording& recording, SweepPoints points,
                   const identification::JointTerms& terms);

/// Value and standard error by name; NaN where the model does not have it.
struct Estimate {
  double value = std::numeric_limits<double>::quiet_NaN();
  double standard_error = std::numeric_limits<double>::quiet_NaN();
};
Estimate parameter(const SweepFit& fit, const std::string& name);

}  // namespace sprung
