#pragma once
/// What can be fitted: a function from a joint's motion and a few parameters to the torque (or current) that
/// the motor must give. Pure.
#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

#include "estimator/identification/dataset.h"

namespace sprung::identification {

struct FitParameter {
  std::string name;  ///< "coulomb"; unique within a model
  std::string unit;  ///< "Nm"
  double initial = 0.0;
  double lower = -std::numeric_limits<double>::infinity();  ///< lower <= initial <= upper
  double upper = std::numeric_limits<double>::infinity();
  /// Further starts for parameters in which the problem is not convex (Stribeck speed, presliding stiffness).
  /// Every combination of one model's starts is tried, so keep them few.
  std::vector<double> more_starts = {};
  /// What motion tells this parameter from others, for warnings: "slow reversals", "the joint loaded both
  /// ways".
  std::string told_by = {};
};

class FitModel {
 public:
  virtual ~FitModel() = default;

  virtual std::string name() const = 0;  ///< "stribeck"; unique in a list of candidates
  virtual const std::vector<FitParameter>& parameters() const = 0;

  /// @param parameters one value for each of parameters(), within its bounds.
  /// @param prediction resized to data.size(), in data.torque_unit.
  /// @param jacobian where not null resized to data.size() x parameters().size(): d prediction / d parameter.
  /// Deterministic; any finite parameters within the bounds give finite predictions.
  virtual void predict(const JointDataset& data, const Eigen::VectorXd& parameters,
                       Eigen::VectorXd& prediction, Eigen::MatrixXd* jacobian) const = 0;
};

}  // namespace sprung::identification
