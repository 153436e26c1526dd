#pragma once
/// A geared joint's measured torque from its motion. Pure.
///
///   torque = inertia qdd + L + offset + f(qd, L) + sum over h of ripple_h (c_h cos(h R q) + s_h sin(h R q))
///   L = gravity_cos cos q + gravity_sin sin q, or load_gain * load where the dataset knows the load, or the
///   sum of both where it knows what a weight adds (load_beside_own)
///
/// f is the friction law (model/friction/friction_law.h), R q the motor's angle. Where the load is known,
/// inertia is what lies on the motor's side of it: the armature; else it is all that turns with the joint
/// (but a known weight), and its share of L is left out, since no motion tells armature from link. All
/// torques are in the unit of the measured one.
#include "estimator/identification/fit_model.h"
#include "estimator/identification/joint_terms.h"
#include "model/friction/friction_law.h"

namespace sprung::identification {

class JointModel : public FitModel {
 public:
  /// @param data gives unit, scales for starts, and whether the load is known; it is not kept.
  /// @throws std::invalid_argument on a term that misses what it builds on, or that is named twice.
  JointModel(const JointTerms& terms, const JointDataset& data);

  std::string name() const override { return identification::name(terms_); }
  const std::vector<FitParameter>& parameters() const override { return parameters_; }
  void predict(const JointDataset& data, const Eigen::VectorXd& parameters, Eigen::VectorXd& prediction,
               Eigen::MatrixXd* jacobian) const override;

  const JointTerms& terms() const { return terms_; }
  /// The friction law's part of `parameters`.
  FrictionParameters friction(const Eigen::VectorXd& parameters) const;
  /// Gear output torque, in the unit of the measured torque, from that and the motion: what is left after
  /// inertia, offset, ripple and friction (friction/gear_output.h). The load of the dataset and gravity are
  /// not used.
  Eigen::VectorXd gear_output(const JointDataset& data, const Eigen::VectorXd& parameters) const;

 private:
  struct Layout {
    Eigen::Index gravity = -1;  ///< cosine; the sine follows. -1: the whole load is known
    Eigen::Index load_gain = -1;
    Eigen::Index offset = 0;
    Eigen::Index friction = 0;  ///< first of the friction law's, in order of friction_
    Eigen::Index ripple = 0;    ///< first of the ripple's, in order of harmonics_
  };
  struct Regressors;
  Regressors regressors(const JointDataset& data, Eigen::Index i) const;
  double load(const Regressors& at, const JointDataset& data, const Eigen::VectorXd& parameters,
              Eigen::Index i) const;
  /// Inertia, offset and ripple.
  double beside_load(const Regressors& at, const JointDataset& data, const Eigen::VectorXd& parameters,
                     Eigen::Index i) const;
  void fill_row(const Regressors& at, const JointDataset& data, Eigen::Index i, const FrictionValue& friction,
                Eigen::MatrixXd& jacobian) const;

  JointTerms terms_;
  std::vector<FrictionParameter> friction_;
  std::vector<int> harmonics_;
  bool has_load_;
  bool fits_gravity_;
  Layout at_;
  std::vector<FitParameter> parameters_;
};

}  // namespace sprung::identification
