#pragma once
/// Parameters within bounds as variables without: what MINUIT and lmfit do around MINPACK. Pure.
///
///   both bounds   x = lower + (upper - lower) (1 + sin u) / 2
///   lower only    x = lower + s (sqrt(u^2 + 1) - 1); upper only likewise
///   none          x = u
/// s: distance of start or initial value to the bound.
///
/// At a bound dx/du is zero, and a search would stay there: what starts on a bound is left out of the
/// variables and keeps its value; moved_inside() first where that is not wanted.
#include <Eigen/Core>
#include <vector>

#include "estimator/identification/fit_model.h"

namespace sprung::identification {

/// `value`, or a hundredth of the range inside where it is nearer to a bound.
double moved_inside(const FitParameter& parameter, double value);

class BoundedVariables {
 public:
  /// @throws std::invalid_argument naming a parameter whose bounds are crossed.
  BoundedVariables(const std::vector<FitParameter>& parameters, const Eigen::VectorXd& start);

  Eigen::VectorXd start() const { return start_; }  ///< variables of the start
  /// Parameter of each variable, ascending.
  const std::vector<Eigen::Index>& free() const { return free_; }
  Eigen::VectorXd parameters(const Eigen::VectorXd& variables) const;
  /// d parameter / d variable, of each variable.
  Eigen::VectorXd slope(const Eigen::VectorXd& variables) const;
  /// Within a millionth of the range (or of s) of a bound.
  bool at_bound(const Eigen::VectorXd& parameters, Eigen::Index i) const;
  double range(Eigen::Index i) const;  ///< between the bounds, or s; infinite without bounds

 private:
  enum class Kind { kFree, kLower, kUpper, kBoth };
  struct Variable {
    Kind kind = Kind::kFree;
    double lower = 0.0;
    double upper = 0.0;
    double scale = 1.0;
  };
  static Variable variable_of(const FitParameter& parameter, double start);
  static double variable_at(const Variable& variable, double value);

  static double parameter_at(const Variable& variable, double u);
  static double slope_at(const Variable& variable, double u);

  std::vector<Variable> variables_;  ///< of every parameter
  std::vector<Eigen::Index> free_;
  Eigen::VectorXd fixed_;  ///< every parameter's start
  Eigen::VectorXd start_;
};

}  // namespace sprung::identification
