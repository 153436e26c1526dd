#include "estimator/identification/bounded_variables.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sprung::identification {

namespace {

using Index = Eigen::Index;

constexpr double kInside = 0.01;   ///< share of the range that a start keeps from its bounds
constexpr double kAtBound = 1e-6;  ///< share of the range that counts as on the bound

}  // namespace

BoundedVariables::Variable BoundedVariables::variable_of(const FitParameter& parameter, double start) {
  Variable out;
  out.lower = parameter.lower;
  out.upper = parameter.upper;
  const bool lower = std::isfinite(parameter.lower);
  const bool upper = std::isfinite(parameter.upper);
  if (lower && upper) {
    out.kind = parameter.lower == parameter.upper ? Kind::kFixed : Kind::kBoth;
    out.scale = parameter.upper - parameter.lower;
  } else if (lower || upper) {
    out.kind = lower ? Kind::kLower : Kind::kUpper;
    const double bound = lower ? parameter.lower : parameter.upper;
    const double distance = std::max(std::abs(start - bound), std::abs(parameter.initial - bound));
    out.scale = distance > 0.0 ? distance : 1.0;
  }
  return out;
}

double BoundedVariables::variable_at(const Variable& variable, double value) {
  const auto one_sided = [&](double distance) {
    const double root = std::max(distance / variable.scale, kInside) + 1.0;
    return std::sqrt(root * root - 1.0);
  };
  switch (variable.kind) {
    case Kind::kFree:
      return value;
    case Kind::kLower:
      return one_sided(value - variable.lower);
    case Kind::kUpper:
      return one_sided(variable.upper - value);
    case Kind::kBoth:
      return std::asin(2.0 * std::clamp((value - variable.lower) / variable.scale, kInside, 1.0 - kInside) -
                       1.0);
    case Kind::kFixed:
      break;
  }
  return 0.0;
}

BoundedVariables::BoundedVariables(const std::vector<FitParameter>& parameters, const Eigen::VectorXd& start)
    : start_(start.size()) {
  for (Index i = 0; i < start.size(); ++i) {
    const FitParameter& parameter = parameters[static_cast<std::size_t>(i)];
    if (!(parameter.lower <= parameter.upper))
      throw std::invalid_argument("bounds of '" + parameter.name + "' are crossed");
    variables_.push_back(variable_of(parameter, start[i]));
    start_[i] = variable_at(variables_.back(), start[i]);
  }
}

Eigen::VectorXd BoundedVariables::parameters(const Eigen::VectorXd& variables) const {
  Eigen::VectorXd out(variables.size());
  for (Index i = 0; i < out.size(); ++i) {
    const Variable& v = variables_[static_cast<std::size_t>(i)];
    const double u = variables[i];
    const double distance = v.scale * (std::sqrt(u * u + 1.0) - 1.0);
    switch (v.kind) {
      case Kind::kFree:
        out[i] = u;
        break;
      case Kind::kLower:
        out[i] = v.lower + distance;
        break;
      case Kind::kUpper:
        out[i] = v.upper - distance;
        break;
      case Kind::kBoth:
        out[i] = std::clamp(v.lower + v.scale * (1.0 + std::sin(u)) / 2.0, v.lower, v.upper);
        break;
      case Kind::kFixed:
        out[i] = v.lower;
        break;
    }
  }
  return out;
}

Eigen::VectorXd BoundedVariables::slope(const Eigen::VectorXd& variables) const {
  Eigen::VectorXd out(variables.size());
  for (Index i = 0; i < out.size(); ++i) {
    const Variable& v = variables_[static_cast<std::size_t>(i)];
    const double u = variables[i];
    const double one_sided = v.scale * u / std::sqrt(u * u + 1.0);
    switch (v.kind) {
      case Kind::kFree:
        out[i] = 1.0;
        break;
      case Kind::kLower:
        out[i] = one_sided;
        break;
      case Kind::kUpper:
        out[i] = -one_sided;
        break;
      case Kind::kBoth:
        out[i] = v.scale * std::cos(u) / 2.0;
        break;
      case Kind::kFixed:
        out[i] = 0.0;
        break;
    }
  }
  return out;
}

bool BoundedVariables::at_bound(const Eigen::VectorXd& parameters, Eigen::Index i) const {
  const Variable& v = variables_[static_cast<std::size_t>(i)];
  const double slack = kAtBound * v.scale;
  return v.kind != Kind::kFree && (parameters[i] - v.lower <= slack || v.upper - parameters[i] <= slack);
}

}  // namespace sprung::identification
