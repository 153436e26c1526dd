#include "estimator/identification/least_squares.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "estimator/identification/bounded_variables.h"

namespace sprung::identification {

namespace {

using Index = Eigen::Index;

constexpr double kTolerance = 1e-10;  ///< relative, of parameters and of the cost
constexpr double kSettled = 1e-6;     ///< parameters' relative change that ends reweighting
constexpr double kPushedInward =
    1e-6;                         ///< cosine between residual and column that counts as a push off the bound
constexpr int kMostReleases = 3;  ///< of parameters from bounds that do not act

/// Residuals and Jacobian in unbounded variables, each row times the root of its weight.
class Functor : public Eigen::DenseFunctor<double> {
 public:
  Functor(const FitProblem& problem, const BoundedVariables& variables, const Eigen::VectorXd& weight)
      : DenseFunctor(static_cast<int>(variables.start().size()), static_cast<int>(problem.size())),
        problem_(problem),
        variables_(variables),
        root_weight_(weight.cwiseSqrt()) {}

  int operator()(const InputType& u, ValueType& residual) const {
    problem_.evaluate(variables_.parameters(u), residual, nullptr);
    residual.array() *= root_weight_.array();
    return residual.allFinite() ? 0 : -1;
  }

  int df(const InputType& u, JacobianType& jacobian) const {
    ValueType residual;
    problem_.evaluate(variables_.parameters(u), residual, &jacobian);
    jacobian = root_weight_.asDiagonal() * jacobian * variables_.slope(u).asDiagonal();
    return jacobian.allFinite() ? 0 : -1;
  }

 private:
  const FitProblem& problem_;
  const BoundedVariables& variables_;
  Eigen::VectorXd root_weight_;
};

double cost_of(const Eigen::VectorXd& weight, const Eigen::VectorXd& residual) {
  return 0.5 * weight.dot(residual.cwiseAbs2());
}

Fit search_once(const FitProblem& problem, const Eigen::VectorXd& start, const Eigen::VectorXd& weight,
                const FitOptions& options) {
  const BoundedVariables variables(problem.model().parameters(), start);
  Functor functor(problem, variables, weight);
  Eigen::LevenbergMarquardt<Functor> search(functor);
  search.setXtol(kTolerance);
  search.setFtol(kTolerance);
  search.setMaxfev(options.most_evaluations);
  Eigen::VectorXd u = variables.start();
  const auto status = search.minimize(u);
  if (status == Eigen::LevenbergMarquardtSpace::UserAsked)
    throw std::runtime_error("model '" + problem.model().name() + "' gave a prediction that is not finite");
  Fit out;
  out.parameters = variables.parameters(u);
  out.weight = weight;
  out.converged = status != Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation;
  for (Index i = 0; i < u.size(); ++i) out.at_bound.push_back(variables.at_bound(out.parameters, i));
  return out;
}

/// A search in transformed variables can end on a bound from which the data push it away: there the slope is zero.
bool pushed_inward(const Fit& found, const FitParameter& parameter, double value, double cosine) {
  if (parameter.lower == parameter.upper) return false;
  const bool low = value - parameter.lower < parameter.upper - value;
  return std::abs(cosine) > kPushedInward && (low ? cosine < 0.0 : cosine > 0.0) && found.converged;
}

/// @return whether a parameter was released; `found.cost` is set either way.
bool release(const FitProblem& problem, Fit& found) {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  problem.evaluate(found.parameters, residual, &jacobian);
  found.cost = cost_of(found.weight, residual);
  const Eigen::VectorXd root = found.weight.cwiseSqrt();
  const Eigen::VectorXd weighted = root.cwiseProduct(residual);
  bool released = false;
  for (Index i = 0; i < jacobian.cols(); ++i) {
    if (!found.at_bound[static_cast<std::size_t>(i)]) continue;
    const Eigen::VectorXd column = root.cwiseProduct(jacobian.col(i));
    const double norms = column.norm() * weighted.norm();
    const double cosine = norms > 0.0 ? column.dot(weighted) / norms : 0.0;
    released |= pushed_inward(found, problem.model().parameters()[static_cast<std::size_t>(i)],
                              found.parameters[i], cosine);
  }
  return released;
}

Fit search(const FitProblem& problem, const Eigen::VectorXd& start, const Eigen::VectorXd& weight,
           const FitOptions& options) {
  Fit found = search_once(problem, start, weight, options);
  // A new search moves parameters off their bounds before it begins.
  for (int i = 0; release(problem, found) && i < kMostReleases; ++i) {
    Fit again = search_once(problem, found.parameters, weight, options);
    release(problem, again);
    if (again.cost >= found.cost) break;
    found = again;
  }
  return found;
}

bool settled(const Eigen::VectorXd& before, const Eigen::VectorXd& after) {
  return (after - before).norm() <= kSettled * after.norm();
}

void reweight(const FitProblem& problem, RobustLoss loss, const FitOptions& options, Fit& found) {
  for (int i = 0; i < options.most_reweightings; ++i) {
    Eigen::VectorXd residual;
    problem.evaluate(found.parameters, residual, nullptr);
    const Eigen::VectorXd weight =
        problem.weight().cwiseProduct(robust_weights(residual, robust_scale(residual), loss));
    Fit next = search(problem, found.parameters, weight, options);
    const bool done = settled(found.parameters, next.parameters);
    found = std::move(next);
    if (done) return;
  }
}

/// Every combination of the parameters' starts, the first parameter's turning slowest.
std::vector<Eigen::VectorXd> starts(const std::vector<FitParameter>& parameters, int most) {
  Eigen::VectorXd initial(static_cast<Index>(parameters.size()));
  for (Index i = 0; i < initial.size(); ++i) initial[i] = parameters[static_cast<std::size_t>(i)].initial;
  std::vector<Eigen::VectorXd> out{initial};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const std::size_t before = out.size();
    for (const double value : parameters[i].more_starts) {
      for (std::size_t k = 0; k < before; ++k) {
        out.push_back(out[k]);
        out.back()[static_cast<Index>(i)] = value;
      }
    }
  }
  if (out.size() > static_cast<std::size_t>(most)) out.resize(static_cast<std::size_t>(most));
  return out;
}

void apply_robust_loss(const FitProblem& problem, const FitOptions& options, Fit& found) {
  if (options.loss == RobustLoss::kNone) return;
  reweight(problem, RobustLoss::kHuber, options, found);
  if (options.loss == RobustLoss::kTukey) reweight(problem, RobustLoss::kTukey, options, found);
}

}  // namespace

Fit fit_from(const FitProblem& problem, const Eigen::VectorXd& start, const FitOptions& options) {
  Fit found = search(problem, start, problem.weight(), options);
  apply_robust_loss(problem, options, found);
  found.starts = 1;
  return found;
}

Fit fit(const FitProblem& problem, const FitOptions& options) {
  Fit best;
  const auto all = starts(problem.model().parameters(), options.most_starts);
  for (const Eigen::VectorXd& start : all) {
    Fit found = search(problem, start, problem.weight(), options);
    if (best.starts++ == 0 || found.cost < best.cost) {
      found.starts = best.starts;
      best = std::move(found);
    }
  }
  apply_robust_loss(problem, options, best);
  best.starts = static_cast<int>(all.size());
  return best;
}

}  // namespace sprung::identification
