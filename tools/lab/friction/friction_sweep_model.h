#pragma once
/// Equation (4) of S1 at constant speed, where neither rotor nor link accelerates: what the motor gives is
/// the load and the gear's friction. Pure.
///
///   torque = L + f(w, L),  L = known load + gravity_cos cos q + gravity_sin sin q
///
/// Other than the joint model of `sprung identify` it has no inertia, which constant speeds do not show, and
/// no offset, which one direction alone cannot tell from Coulomb friction.
#include "estimator/identification/fit_model.h"
#include "estimator/identification/joint_terms.h"

namespace sprung {

/// Where a fit begins: near enough for the Stribeck term, in which the problem is not convex.
struct SweepStart {
  double coulomb_Nm = 1.0;
  double viscous_Nm_s_rad = 1.0;
  double slowest_rad_s = 0.01;  ///< of the data: a Stribeck speed beyond these two cannot be seen
  double fastest_rad_s = 1.0;
};

class SweepModel : public identification::FitModel {
 public:
  /// @param terms of friction: viscous, stribeck, load and asymmetry are used.
  /// @param own_weight the link's weight is not in data.load_Nm and is to be found.
  SweepModel(const identification::JointTerms& terms, bool own_weight, const SweepStart& start);

  std::string name() const override { return identification::name(terms_); }
  const std::vector<identification::FitParameter>& parameters() const override { return parameters_; }
  void predict(const identification::JointDataset& data, const Eigen::VectorXd& parameters,
               Eigen::VectorXd& prediction, Eigen::MatrixXd* jacobian) const override;

  FrictionParameters friction(const Eigen::VectorXd& parameters) const;
  /// L of each sample.
  Eigen::VectorXd load_Nm(const identification::JointDataset& data, const Eigen::VectorXd& parameters) const;

 private:
  Eigen::Index friction_at() const { return own_weight_ ? 2 : 0; }

  identification::JointTerms terms_;
  std::vector<FrictionParameter> friction_;
  bool own_weight_;
  std::vector<identification::FitParameter> parameters_;
};

}  // namespace sprung
