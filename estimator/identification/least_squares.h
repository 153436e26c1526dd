#pragma once
/// Robust nonlinear least squares with bounds: Eigen's Levenberg-Marquardt (MINPACK's lmder) inside
/// reweighting. Pure, deterministic.
#include <Eigen/Core>
#include <vector>

#include "estimator/identification/fit_problem.h"
#include "estimator/identification/robust_weights.h"

namespace sprung::identification {

struct FitOptions {
  RobustLoss loss = RobustLoss::kHuber;
  int most_evaluations = 120;  ///< of the model, in one search
  int most_reweightings = 20;
  int most_starts = 64;  ///< of all combinations of the parameters' starts
};

struct Fit {
  Eigen::VectorXd parameters;
  std::vector<bool> at_bound;  ///< the bound acts: the data would go on beyond it
  Eigen::VectorXd weight;      ///< of each sample that counts: given weight times the robust loss's
  double cost = 0.0;           ///< sum of weight * residual^2 / 2
  bool converged = true;       ///< false: evaluations ran out
  int starts = 0;              ///< searches tried
};

/// Searches from every start without the robust loss, and goes on with it from the best.
Fit fit(const FitProblem& problem, const FitOptions& options);
/// One search from `start`, near which the solution is known to lie; bounds that it lies on are left only if
/// they do not act.
Fit fit_from(const FitProblem& problem, const Eigen::VectorXd& start, const FitOptions& options);

}  // namespace sprung::identification
