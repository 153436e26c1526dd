#include "estimator/identification/bounded_variables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace sprung::identification {

namespace {

using Index = Eigen::Index;

constexpr double kInside = 0.01;   ///< share of the range that a start keeps from its bounds
constexpr double kAtBound = 1e-6;  ///< share of the range that counts as on the bound

/// Of a parameter with one bound: distance of start or initial value to it.
double range_of(const FitParameter& parameter, double start) {
  const double bound = std::isfinite(parameter.lower) ? parameter.lower : parameter.upper;
  const double distance = std::max(std::abs(start - bound), std::abs(parameter.initial - bound));
  return distance > 0.0 && std::isfinite(distance) ? distance : 1.0;
}

}  // namespace

double moved_inside(const FitParameter& parameter, double value) {
  const double width = parameter.upper - parameter.lower;
  const double range = std::isfinite(width) ? width : range_of(parameter, value);
  if (value - parameter.lower < kInside * range) value = parameter.lower + kInside * range;
  if (parameter.upper - value < kInside * range) value = parameter.upper - kInside * range;
  return value;
}

BoundedVariables::Variable BoundedVariables::variable_of(const FitParameter& parameter, double start) {
  Variable out;
  out.lower = parameter.lower;
  out.upper = parameter.upper;
  const bool lower = std::isfinite(parameter.lower);
  const bool upper = std::isfinite(parameter.upper);
  if (lower && upper) {
    out.kind = Kind::kBoth;
    out.scale = parameter.upper - parameter.lower;
  } else if (lower || upper) {
    out.kind = lower ? Kind::kLower : Kind::kUpper;
    out.scale = range_of(parameter, start);
  }
  return out;
}

double BoundedVariables::variable_at(const Variable& variable, double value) {
  const auto one_sided = [&](double distance) {
    const double root = std::max(distance / variable.scale, 0.0) + 1.0;
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
      return std::asin(std::clamp(2.0 * (value - variable.lower) / variable.scale - 1.0, -1.0, 1.0));
  }
  return 0.0;
}

BoundedVariables::BoundedVariables(const std::vector<FitParameter>& parameters, const Eigen::VectorXd& start)
    : fixed_(start), start_(start.size()) {
  for (Index i = 0; i < start.size(); ++i) {
    const FitParameter& parameter = parameters[i];
    if (!(parameter.lower <= parameter.upper))
      throw std::invalid_argument("bounds of '" + parameter.name + "' are crossed");
    fixed_[i] = std::clamp(start[i], parameter.lower, parameter.upper);
    variables_.push_back(variable_of(parameter, fixed_[i]));
    if (fixed_[i] == parameter.lower || fixed_[i] == parameter.upper) continue;
    start_[static_cast<Index>(free_.size())] = variable_at(variables_.back(), fixed_[i]);
    free_.push_back(i);
  }
  start_.conservativeResize(static_cast<Index>(free_.size()));
}

double BoundedVariables::parameter_at(const Variable& v, double u) {
  const double distance = v.scale * (std::sqrt(u * u + 1.0) - 1.0);
  switch (v.kind) {
    case Kind::kLower:
      return v.lower + distance;
    case Kind::kUpper:
      return v.upper - distance;
    case Kind::kBoth:
      return std::clamp(v.lower + v.scale * (1.0 + std::sin(u)) / 2.0, v.lower, v.upper);
    case Kind::kFree:
      break;
  }
  return u;
}

double BoundedVariables::slope_at(const Variable& v, double u) {
  const double one_sided = v.scale * u / std::sqrt(u * u + 1.0);
  switch (v.kind) {
    case Kind::kLower:
      return one_sided;
    case Kind::kUpper:
      return -one_sided;
    case Kind::kBoth:
      return v.scale * std::cos(u) / 2.0;
    case Kind::kFree:
      break;
  }
  return 1.0;
}

Eigen::VectorXd BoundedVariables::parameters(const Eigen::VectorXd& variables) const {
  Eigen::VectorXd out = fixed_;
  for (std::size_t k = 0; k < free_.size(); ++k)
    out[free_[k]] = parameter_at(variables_[free_[k]], variables[static_cast<Index>(k)]);
  return out;
}

Eigen::VectorXd BoundedVariables::slope(const Eigen::VectorXd& variables) const {
  Eigen::VectorXd out(variables.size());
  for (std::size_t k = 0; k < free_.size(); ++k)
    out[static_cast<Index>(k)] = slope_at(variables_[free_[k]], variables[static_cast<Index>(k)]);
  return out;
}

bool BoundedVariables::at_bound(const Eigen::VectorXd& parameters, Eigen::Index i) const {
  const Variable& v = variables_[i];
  const double slack = kAtBound * v.scale;
  return v.kind != Kind::kFree && (parameters[i] - v.lower <= slack || v.upper - parameters[i] <= slack);
}

double BoundedVariables::range(Eigen::Index i) const {
  const Variable& v = variables_[i];
  return v.kind == Kind::kFree ? std::numeric_limits<double>::infinity() : v.scale;
}

}  // namespace sprung::identification
