#include "tools/lab/friction/friction_sweep_model.h"

#include <cmath>

#include "model/friction/friction_law.h"

namespace sprung {
namespace {

using Eigen::Index;
using identification::FitParameter;
using identification::JointDataset;
using P = FrictionParameter;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Shares at which the Stribeck speed starts between the slowest and the fastest, in logarithm.
constexpr double kStribeckStarts[] = {0.5, 0.2};

double between(const SweepStart& start, double share) {
  return start.slowest_rad_s * std::pow(start.fastest_rad_s / start.slowest_rad_s, share);
}

FitParameter friction_parameter(P parameter, const SweepStart& start) {
  const FrictionParameterInfo& i = info(parameter);
  FitParameter out{i.name, i.unit, i.off, i.low, i.high};
  switch (parameter) {
    case P::kCoulomb:
      out.initial = start.coulomb_Nm;
      break;
    case P::kStribeck:
      out.initial = 0.2 * start.coulomb_Nm;
      break;
    case P::kStribeckSpeed:
      out.initial = between(start, kStribeckStarts[0]);
      out.more_starts = {between(start, kStribeckStarts[1])};
      out.lower = start.slowest_rad_s;
      out.upper = start.fastest_rad_s;
      out.told_by = "slow and fast passes";
      break;
    case P::kViscous:
      out.initial = start.viscous_Nm_s_rad;
      out.told_by = "different speeds";
      break;
    case P::kLoadShareDriving:
    case P::kLoadShareDriven:
      out.initial = 0.05;
      out.told_by = "loads in both directions";
      break;
    default:
      out.told_by = "passes in both directions";
      break;
  }
  return out;
}

}  // namespace

SweepModel::SweepModel(const identification::JointTerms& terms, bool own_weight, const SweepStart& start)
    : terms_(terms), friction_(identification::friction_of(terms)), own_weight_(own_weight) {
  if (own_weight_) {
    for (const char* part : {"gravity_cos", "gravity_sin"})
      parameters_.push_back({part, "Nm", 0.0, -kInfinity, kInfinity, {}, "positions far from each other"});
  }
  for (const P parameter : friction_) parameters_.push_back(friction_parameter(parameter, start));
}

FrictionParameters SweepModel::friction(const Eigen::VectorXd& parameters) const {
  FrictionParameters out;
  for (std::size_t k = 0; k < friction_.size(); ++k)
    out.*(info(friction_[k]).member) = parameters[friction_at() + static_cast<Index>(k)];
  return out;
}

Eigen::VectorXd SweepModel::load_Nm(const JointDataset& data, const Eigen::VectorXd& parameters) const {
  Eigen::VectorXd out = data.has_load() ? data.load_Nm : Eigen::VectorXd::Zero(data.size());
  if (own_weight_)
    out.array() += parameters[0] * data.position_rad.array().cos() +
                   parameters[1] * data.position_rad.array().sin();
  return out;
}

void SweepModel::predict(const JointDataset& data, const Eigen::VectorXd& parameters,
                         Eigen::VectorXd& prediction, Eigen::MatrixXd* jacobian) const {
  const FrictionParameters law = friction(parameters);
  prediction = load_Nm(data, parameters);
  if (jacobian != nullptr) jacobian->setZero(data.size(), parameters.size());
  for (Index i = 0; i < data.size(); ++i) {
    FrictionInput in;
    in.velocity_rad_s = data.velocity_rad_s[i];
    in.gear_output_torque_Nm = prediction[i];
    const FrictionValue f = evaluate(law, in);
    prediction[i] += f.torque_Nm;
    if (jacobian == nullptr) continue;
    if (own_weight_) {
      (*jacobian)(i, 0) = (1.0 + f.by_load) * std::cos(data.position_rad[i]);
      (*jacobian)(i, 1) = (1.0 + f.by_load) * std::sin(data.position_rad[i]);
    }
    for (std::size_t k = 0; k < friction_.size(); ++k)
      (*jacobian)(i,
                  friction_at() + static_cast<Index>(k)) = f.gradient[static_cast<std::size_t>(friction_[k])];
  }
}

}  // namespace sprung
