#pragma once
/// How well a fit is known and how good it is. Pure.
#include <Eigen/Core>
#include <string>
#include <vector>

#include "estimator/identification/least_squares.h"

namespace sprung::identification {

/// Held-out or not: the caller says which samples count.
struct FitScore {
  double r2 = 0.0;   ///< 1 - var(residual) / var(measured): a constant error does not count
  double rms = 0.0;  ///< of the residual, constant error included; unit of the torque
  Eigen::Index samples = 0;
};
FitScore score(const FitProblem& problem, const Eigen::VectorXd& parameters);
FitScore score(const Eigen::VectorXd& measured, const Eigen::VectorXd& residual);

/// Samples that one independent sample is worth of: 1 + 2 * sum of the autocorrelation up to its first zero,
/// >= 1.
/// @param stretches as FitProblem::stretches(); lags do not reach over gaps.
double autocorrelation_time(const Eigen::VectorXd& residual, const std::vector<Eigen::Index>& stretches);

struct FitStatistics {
  /// sigma^2 * autocorrelation time * (J^T W J)^-1: as if the residuals' slow part were as slow in every
  /// direction, which errs toward large. NaN for a parameter on its bound, and for one that the data say
  /// nothing about.
  Eigen::VectorXd standard_error;
  /// Of the parameters that have a standard error; 0 beside the diagonal for others.
  Eigen::MatrixXd correlation;
  double autocorrelation_time = 1.0;
  double effective_samples = 0.0;     ///< sum of weights / autocorrelation time
  std::vector<std::string> warnings;  ///< one sentence each, with what to do
};
FitStatistics statistics(const FitProblem& problem, const Fit& fit);

}  // namespace sprung::identification
