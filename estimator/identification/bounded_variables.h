#pragma once
/// Parameters within bounds as variables without: what MINUIT and lmfit do around MINPACK. Pure.
///
///   both bounds   x = lower + (upper - lower) (1 + sin u) / 2
///   lower only    x = lower + s (sqrt(u^2 + 1) - 1)         s: distance of start or initial value to the bound; upper only likewise
///   none          x = u
///
/// At a bound dx/du is zero, and a search that starts there would stay: starts are moved a little inside.
#include <Eigen/Core>
#include <vector>

#include "estimator/identification/fit_model.h"

namespace sprung::identification {

class BoundedVariables {
 public:
  /// @throws std::invalid_argument naming a parameter whose bounds are crossed.
  BoundedVariables(const std::vector<FitParameter>& parameters, const Eigen::VectorXd& start);

  Eigen::VectorXd start() const { return start_; }  ///< variables of the start
  Eigen::VectorXd parameters(const Eigen::VectorXd& variables) const;
  /// d parameter / d variable of each.
  Eigen::VectorXd slope(const Eigen::VectorXd& variables) const;
  /// Within a millionth of the range (or of s) of a bound.
  bool at_bound(const Eigen::VectorXd& parameters, Eigen::Index i) const;

 private:
  enum class Kind { kFree, kLower, kUpper, kBoth, kFixed };
  struct Variable {
    Kind kind = Kind::kFree;
    double lower = 0.0;
    double upper = 0.0;
    double scale = 1.0;
  };
  static Variable variable_of(const FitParameter& parameter, double start);
  static double variable_at(const Variable& variable, double value);

  std::vector<Variable> variables_;
  Eigen::VectorXd start_;
};

}  // namespace sprung::identification
