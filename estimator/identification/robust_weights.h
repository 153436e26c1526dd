#pragma once
/// Weights by which far residuals lose their say (iteratively reweighted least squares). Pure.
#include <Eigen/Core>

namespace sprung::identification {

/// How far residuals beyond a few standard deviations (1.4826 times the median of |residual|) count.
enum class RobustLoss {
  kNone,   ///< squared, however far
  kHuber,  ///< linear beyond 3: convex; what a model leaves out is within 3, what a bad sample does is beyond
  kTukey,  ///< nothing beyond 4.685; begins at Huber's solution
};

/// 1.4826 times the median of |residual|: the standard deviation, were they normal. 0 for no residuals.
double robust_scale(const Eigen::VectorXd& residual);

/// 1 near zero, falling as the loss says; 1 everywhere for a scale of 0.
Eigen::VectorXd robust_weights(const Eigen::VectorXd& residual, double scale, RobustLoss loss);

}  // namespace sprung::identification
