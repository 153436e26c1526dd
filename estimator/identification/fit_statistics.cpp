#include "estimator/identification/fit_statistics.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "estimator/identification/fit_warnings.h"

namespace sprung::identification {

namespace {

using Index = Eigen::Index;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kSingular = 1e-6;  ///< smallest over largest singular value of the normalised Jacobian

double variance(const Eigen::VectorXd& values) { return (values.array() - values.mean()).square().mean(); }

/// Sum of products of samples `lag` apart, within stretches.
double product_at(const Eigen::VectorXd& residual, const std::vector<Index>& stretches, Index lag) {
  double sum = 0.0;
  for (std::size_t s = 0; s + 1 < stretches.size(); ++s) {
    const Index count = stretches[s + 1] - stretches[s] - lag;
    if (count > 0)
      sum += residual.segment(stretches[s], count).dot(residual.segment(stretches[s] + lag, count));
  }
  return sum;
}

/// Columns of the weighted Jacobian that belong to parameters which the data can move.
struct FreeColumns {
  std::vector<Index> parameter;
  Eigen::MatrixXd jacobian;  ///< columns of length 1
  Eigen::VectorXd norm;
};

FreeColumns free_columns(const Fit& fit, const Eigen::MatrixXd& weighted) {
  FreeColumns out;
  const double largest = weighted.colwise().norm().maxCoeff();
  for (Index i = 0; i < weighted.cols(); ++i) {
    const double norm = weighted.col(i).norm();
    if (fit.at_bound[i] || !(norm > largest * 1e-12)) continue;
    out.parameter.push_back(i);
  }
  const Index n = static_cast<Index>(out.parameter.size());
  out.jacobian.resize(weighted.rows(), n);
  out.norm.resize(n);
  for (Index k = 0; k < n; ++k) {
    const auto column = weighted.col(out.parameter[k]);
    out.norm[k] = column.norm();
    out.jacobian.col(k) = column / out.norm[k];
  }
  return out;
}

/// Covariance of the normalised parameters for a residual variance of 1. Directions that the data do not show
/// are collected in `hidden` instead, each a unit vector.
Eigen::MatrixXd covariance_of(const FreeColumns& free, std::vector<Eigen::VectorXd>& hidden) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(free.jacobian.transpose() * free.jacobian, Eigen::ComputeFullV);
  const Eigen::VectorXd& squares = svd.singularValues();
  const Index n = free.norm.size();
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
  for (Index k = 0; k < n; ++k) {
    const Eigen::VectorXd direction = svd.matrixV().col(k);
    if (squares[k] <= squares[0] * kSingular * kSingular) {
      hidden.push_back(direction);
    } else {
      out += direction * direction.transpose() / squares[k];
    }
  }
  return out;
}

/// Share of a hidden direction above which a parameter counts as not known.
constexpr double kInvolved = 0.1;

bool involved(const std::vector<Eigen::VectorXd>& hidden, Index k) {
  return std::any_of(hidden.begin(), hidden.end(),
                     [&](const Eigen::VectorXd& v) { return std::abs(v[k]) > kInvolved; });
}

void fill(const FreeColumns& free, const Eigen::MatrixXd& covariance,
          const std::vector<Eigen::VectorXd>& hidden, double variance, FitStatistics& out) {
  const Index n = free.norm.size();
  for (Index a = 0; a < n; ++a) {
    const Index i = free.parameter[a];
    if (involved(hidden, a)) continue;
    out.standard_error[i] = std::sqrt(variance * covariance(a, a)) / free.norm[a];
    for (Index b = 0; b < n; ++b) {
      const Index j = free.parameter[b];
      if (!involved(hidden, b))
        out.correlation(i, j) = covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
    }
  }
}

/// The hidden directions in terms of all parameters.
std::vector<Eigen::VectorXd> spread(const FreeColumns& free, const std::vector<Eigen::VectorXd>& hidden,
                                    Index count) {
  std::vector<Eigen::VectorXd> out;
  for (const Eigen::VectorXd& direction : hidden) {
    out.push_back(Eigen::VectorXd::Zero(count));
    for (Index k = 0; k < direction.size(); ++k) out.back()[free.parameter[k]] = direction[k];
  }
  return out;
}

}  // namespace

FitScore score(const Eigen::VectorXd& measured, const Eigen::VectorXd& residual) {
  FitScore out;
  out.samples = residual.size();
  out.rms = std::sqrt(residual.squaredNorm() / static_cast<double>(residual.size()));
  const double all = variance(measured);
  out.r2 = all > 0.0 ? 1.0 - variance(residual) / all : kNone;
  return out;
}

FitScore score(const FitProblem& problem, const Eigen::VectorXd& parameters) {
  Eigen::VectorXd residual;
  problem.evaluate(parameters, residual, nullptr);
  return score(problem.measured(), residual);
}

double autocorrelation_time(const Eigen::VectorXd& residual, const std::vector<Index>& stretches) {
  const Eigen::VectorXd centred = residual.array() - residual.mean();
  const double at_zero = product_at(centred, stretches, 0);
  if (!(at_zero > 0.0)) return 1.0;
  double sum = 1.0;
  for (Index lag = 1; lag < residual.size(); ++lag) {
    const double correlation = product_at(centred, stretches, lag) / at_zero;
    if (correlation <= 0.0) break;
    sum += 2.0 * correlation;
  }
  return sum;
}

FitStatistics statistics(const FitProblem& problem, const Fit& fit) {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  problem.evaluate(fit.parameters, residual, &jacobian);
  const Eigen::VectorXd root = fit.weight.cwiseSqrt();
  const Eigen::VectorXd weighted = root.cwiseProduct(residual);
  const Index count = fit.parameters.size();
  FitStatistics out;
  out.standard_error = Eigen::VectorXd::Constant(count, kNone);
  out.correlation = Eigen::MatrixXd::Identity(count, count);
  out.autocorrelation_time = autocorrelation_time(weighted, problem.stretches());
  out.effective_samples = fit.weight.sum() / out.autocorrelation_time;
  const FreeColumns free = free_columns(fit, root.asDiagonal() * jacobian);
  std::vector<Eigen::VectorXd> hidden;
  const Eigen::MatrixXd covariance = covariance_of(free, hidden);
  // Huber's weights shrink the sum of squares and the curvature alike, so that the mean square of what is
  // left, over the mean weight, stands for the variance.
  const double spare = std::max(1.0, fit.weight.sum() - static_cast<double>(free.norm.size()));
  fill(free, covariance, hidden, weighted.squaredNorm() / spare * out.autocorrelation_time, out);
  out.warnings = fit_warnings(problem.model().parameters(), fit, out, spread(free, hidden, count));
  return out;
}

}  // namespace sprung::identification
