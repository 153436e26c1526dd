#pragma once
/// Calibration of torsion sensing: what the encoders on both sides of a gear differ by besides its torsion.
/// Pure.
///
///   motor / R - link = offset + torsion(load) + sum over h of the motor angle's harmonics
///                    + the same of the link angle's
///
/// The kinematic error of a strain wave gear turns with the motor (docs/sources.md, facts D7: twice a turn,
/// once, four times), that of an encoder's disc with the link; times the gear's stiffness it is several Nm
/// and must go before torsion is a torque (D7, D8). Everything but a stiffness in stages is linear in the
/// parameters.
#include <optional>
#include <vector>

#include "estimator/identification/fit_model.h"

namespace sprung::identification {

struct TorsionStage {
  double from_Nm = 0.0;           ///< the stage acts beyond this |torque|; 0 in the first
  double stiffness_Nm_rad = 0.0;  ///< > 0
};

/// Spring of a strain wave gear: stiffness that grows in stages with the torque, as data sheets give it. Odd:
/// the same both ways.
class TorsionSpring {
 public:
  /// @throws std::invalid_argument unless there is a stage, the first begins at 0, they ascend, and
  /// stiffnesses are positive.
  explicit TorsionSpring(std::vector<TorsionStage> stages);

  double angle_rad(double torque_Nm) const noexcept;
  double torque_Nm(double angle_rad) const noexcept;

 private:
  std::vector<TorsionStage> stages_;
  std::vector<double> from_rad_;  ///< angle at which each stage begins
};

struct FootprintTerms {
  std::vector<int> motor_harmonics = {1, 2, 4};
  std::vector<int> link_harmonics = {1, 2};
  std::optional<TorsionSpring> spring;  ///< of the data sheet; none: one compliance is fitted along
};

/// The same recording with the encoders' difference in the place of the torque, in "rad": what FootprintModel
/// is fitted to.
/// @throws std::invalid_argument where link position or load are missing.
JointDataset encoder_difference(const JointDataset& data);

class FootprintModel : public FitModel {
 public:
  explicit FootprintModel(FootprintTerms terms);

  /// "torsion" without harmonics, "footprint" with.
  std::string name() const override;
  const std::vector<FitParameter>& parameters() const override { return parameters_; }
  /// @param data with link position and load.
  void predict(const JointDataset& data, const Eigen::VectorXd& parameters, Eigen::VectorXd& prediction,
               Eigen::MatrixXd* jacobian) const override;

  /// Gear output torque from both encoders alone, the footprint taken off. @param data with link position.
  Eigen::VectorXd torque_Nm(const JointDataset& data, const Eigen::VectorXd& parameters) const;
  /// Fitted or of the data sheet's first stage.
  double stiffness_Nm_rad(const Eigen::VectorXd& parameters) const;

 private:
  void add_harmonics(const char* side, const std::vector<int>& harmonics);
  /// Columns of all that does not depend on the load.
  Eigen::MatrixXd columns(const JointDataset& data) const;

  FootprintTerms terms_;
  std::vector<FitParameter> parameters_;  ///< the compliance, where it is fitted, comes last
};

}  // namespace sprung::identification
