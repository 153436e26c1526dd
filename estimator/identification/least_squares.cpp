#include "estimator/identification/least_squares.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "estimator/identification/bounded_variables.h"

namespace sprung::identification {

namespace {

using Index = Eigen::Index;

constexpr double kTolerance = 1e-8;  ///< relative, of parameters and of the cost
constexpr double kSettled = 1e-4;    ///< parameters' relative change that ends reweighting
constexpr double kPush = 1e-6;       ///< cosine between residual and column that counts
constexpr double kNear = 1e-3;       ///< share of its range that counts as near a bound
constexpr int kMostRounds = 4;       ///< of searches between which bounds are settled
constexpr int kEvaluationsAtFirst = 40;

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
    Eigen::MatrixXd all;
    problem_.evaluate(variables_.parameters(u), residual, &all);
    const Eigen::VectorXd slope = variables_.slope(u);
    jacobian.resize(all.rows(), u.size());
    for (Index k = 0; k < u.size(); ++k)
      jacobian.col(k) = slope[k] * root_weight_.cwiseProduct(all.col(variables_.free()[k]));
    return jacobian.allFinite() ? 0 : -1;
  }

 private:
  const FitProblem& problem_;
  const BoundedVariables& variables_;
  Eigen::VectorXd root_weight_;
};

struct Search {
  const FitProblem& problem;
  const Eigen::VectorXd& weight;
  const FitOptions& options;
};

[[noreturn]] void not_finite(const FitProblem& problem) {
  throw std::runtime_error("model '" + problem.model().name() + "' gave a prediction that is not finite");
}

Fit search_once(const Search& s, const Eigen::VectorXd& start, int most_evaluations) {
  const BoundedVariables variables(s.problem.model().parameters(), start);
  Functor functor(s.problem, variables, s.weight);
  Fit out;
  out.weight = s.weight;
  Eigen::VectorXd u = variables.start();
  Eigen::VectorXd residual;
  if (functor(u, residual) != 0) not_finite(s.problem);
  if (u.size() > 0) {
    Eigen::LevenbergMarquardt<Functor> search(functor);
    search.setXtol(kTolerance);
    search.setFtol(kTolerance);
    search.setMaxfev(most_evaluations);
    const auto status = search.minimize(u);
    if (status == Eigen::LevenbergMarquardtSpace::UserAsked) not_finite(s.problem);
    out.converged = status != Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation;
    residual = search.fvec();
  }
  out.parameters = variables.parameters(u);
  out.cost = 0.5 * residual.squaredNorm();
  for (Index i = 0; i < out.parameters.size(); ++i)
    out.at_bound.push_back(variables.at_bound(out.parameters, i));
  return out;
}

/// Cosine between the residual and each parameter's column: where growing leads downhill it is negative.
Eigen::VectorXd pushes(const Search& s, const Eigen::VectorXd& parameters) {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  s.problem.evaluate(parameters, residual, &jacobian);
  const Eigen::VectorXd root = s.weight.cwiseSqrt();
  residual.array() *= root.array();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(jacobian.cols());
  for (Index i = 0; i < out.size(); ++i) {
    const Eigen::VectorXd column = root.cwiseProduct(jacobian.col(i));
    const double norms = column.norm() * residual.norm();
    if (norms > 0.0) out[i] = column.dot(residual) / norms;
  }
  return out;
}

bool near_a_bound(const FitParameter& p, double value, double range) {
  return std::isfinite(range) && std::min(value - p.lower, p.upper - value) <= kNear * range;
}

/// Near a bound the transformed search goes wrong both ways: it creeps toward one that acts, and stays on one
/// that does not, since there the slope is zero. So what is pushed against its bound is set on it, and what
/// is pushed off is moved.
/// @return whether anything was changed.
bool settle_bounds(const Search& s, const Fit& found, Eigen::VectorXd& parameters) {
  const auto& all = s.problem.model().parameters();
  const BoundedVariables variables(all, parameters);
  const Eigen::VectorXd push = pushes(s, parameters);
  bool changed = false;
  for (Index i = 0; i < parameters.size(); ++i) {
    const FitParameter& p = all[i];
    if (p.lower == p.upper || !near_a_bound(p, parameters[i], variables.range(i))) continue;
    const bool low = parameters[i] - p.lower < p.upper - parameters[i];
    const bool inward = low ? push[i] < -kPush : push[i] > kPush;
    const bool outward = low ? push[i] > kPush : push[i] < -kPush;
    const double before = parameters[i];
    if (inward && found.at_bound[i]) parameters[i] = moved_inside(p, before);
    if (outward) parameters[i] = low ? p.lower : p.upper;
    changed |= parameters[i] != before;
  }
  return changed;
}

Fit search(const Search& s, const Eigen::VectorXd& start) {
  Fit found = search_once(s, start, std::min(kEvaluationsAtFirst, s.options.most_evaluations));
  for (int round = 0; round < kMostRounds; ++round) {
    Eigen::VectorXd from = found.parameters;
    const bool changed = settle_bounds(s, found, from);
    if (found.converged && !changed) break;
    Fit next = search_once(s, from, s.options.most_evaluations);
    const bool better = next.cost < found.cost * (1.0 - kTolerance);
    if (!better && found.converged) break;
    if (better || next.converged) found = std::move(next);
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
    const Eigen::VectorXd weight = problem.weight().cwiseProduct(
        robust_weights(residual, robust_scale(residual), loss));
    Fit next = search({problem, weight, options}, found.parameters);
    const bool done = settled(found.parameters, next.parameters);
    found = std::move(next);
    if (done) return;
  }
}

/// Every combination of the parameters' starts, the first parameter's turning slowest.
std::vector<Eigen::VectorXd> starts(const std::vector<FitParameter>& parameters, int most) {
  Eigen::VectorXd initial(static_cast<Index>(parameters.size()));
  for (Index i = 0; i < initial.size(); ++i) initial[i] = parameters[i].initial;
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
  for (Eigen::VectorXd& start : out) {
    for (Index i = 0; i < start.size(); ++i) {
      const FitParameter& p = parameters[i];
      if (p.lower < p.upper) start[i] = moved_inside(p, start[i]);
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
  Fit found;
  found.parameters = start;
  if (options.loss == RobustLoss::kNone) {
    found = search({problem, problem.weight(), options}, start);
  } else {
    apply_robust_loss(problem, options, found);
  }
  found.starts = 1;
  return found;
}

Fit fit(const FitProblem& problem, const FitOptions& options) {
  Fit best;
  const auto all = starts(problem.model().parameters(), options.most_starts);
  for (const Eigen::VectorXd& start : all) {
    Fit found = search({problem, problem.weight(), options}, start);
    if (best.parameters.size() == 0 || found.cost < best.cost) best = std::move(found);
  }
  apply_robust_loss(problem, options, best);
  best.starts = static_cast<int>(all.size());
  return best;
}

}  // namespace sprung::identification
