#include "estimator/identification/joint_model.h"

#include <array>
#include <cmath>
#include <complex>
#include <stdexcept>

#include "estimator/identification/joint_parameters.h"
#include "model/friction/coulomb_friction.h"
#include "model/friction/friction_law.h"
#include "model/friction/gear_output.h"
#include "model/friction/presliding_state.h"

namespace sprung::identification {
namespace {

using Index = Eigen::Index;

constexpr Index kInertia = 0;
constexpr std::size_t kRipples = 3;  ///< as many as there are JointTerms of them

/// Without presliding the sign of motion is tanh(qd / this): a measured speed has a sign at rest, but it
/// means nothing.
constexpr double kSignSmoothing_rad_s = kRestSpeed_rad_s;

/// The friction law's input sample by sample; keeps the presliding state.
class FrictionInputs {
 public:
  FrictionInputs(const JointDataset& data, bool presliding, double presliding_rad)
      : data_(data), presliding_(presliding), state_(presliding_rad) {}

  FrictionInput at(Index i, double load) noexcept {
    FrictionInput in;
    in.velocity_rad_s = data_.velocity_rad_s[i];
    in.gear_output_torque_Nm = load;
    if (data_.has_temperature()) in.temperature_C = data_.temperature_C[i];
    if (presliding_) {
      in.sign = state_.step(data_.position_rad[i]);
      in.sign_by_presliding_1_rad = state_.sign_by_presliding_1_rad();
    } else {
      in.sign = std::tanh(in.velocity_rad_s / kSignSmoothing_rad_s);
    }
    return in;
  }

 private:
  const JointDataset& data_;
  bool presliding_;
  PreslidingState state_;
};

void check(const JointTerms& terms, const JointDataset& data) {
  JointTerms before;
  for (const JointTerm term : terms) {
    if (!can_follow(before, term) || !has(possible_terms(data), term))
      throw std::invalid_argument("the term '" + std::string(name(term)) + "' cannot follow '" +
                                  name(before) + "' on this dataset");
    before.push_back(term);
  }
}

}  // namespace

JointModel::JointModel(const JointTerms& terms, const JointDataset& data)
    : terms_(terms),
      friction_(friction_of(terms)),
      harmonics_(identification::ripple_harmonics(terms)),
      has_load_(data.has_load()),
      fits_gravity_(!data.has_load() || data.load_beside_own) {
  check(terms, data);
  parameters_ = joint_parameters(terms, data);
  Index next = kInertia + 1;
  if (fits_gravity_) {
    at_.gravity = next;
    next += 2;
  }
  if (has(terms, JointTerm::kLoadGain)) at_.load_gain = next++;
  at_.offset = next;
  at_.friction = at_.offset + 1;
  at_.ripple = at_.friction + static_cast<Index>(friction_.size());
}

FrictionParameters JointModel::friction(const Eigen::VectorXd& parameters) const {
  FrictionParameters out;
  for (std::size_t k = 0; k < friction_.size(); ++k)
    out.*(info(friction_[k]).member) = parameters[at_.friction + static_cast<Index>(k)];
  return out;
}

/// What the linear terms are multiplied with, at one sample; worked out once for value and derivatives.
struct JointModel::Regressors {
  double cos_q = 0.0, sin_q = 0.0;                    ///< of the joint, where gravity is fitted
  std::array<std::complex<double>, kRipples> ripple;  ///< cosine + i sine of each harmonic of the motor angle
};

JointModel::Regressors JointModel::regressors(const JointDataset& data, Index i) const {
  Regressors out;
  if (fits_gravity_) {
    out.cos_q = std::cos(data.position_rad[i]);
    out.sin_q = std::sin(data.position_rad[i]);
  }
  if (harmonics_.empty()) return out;
  const std::complex<double> turn = std::polar(1.0, data.gear_ratio * data.position_rad[i]);
  std::complex<double> power = 1.0;
  for (std::size_t k = 0, harmonic = 0; k < harmonics_.size(); ++k) {
    for (; harmonic < static_cast<std::size_t>(harmonics_[k]); ++harmonic) power *= turn;
    out.ripple[k] = power;
  }
  return out;
}

double JointModel::load(const Regressors& at, const JointDataset& data, const Eigen::VectorXd& parameters,
                        Index i) const {
  double sum = 0.0;
  if (has_load_) sum = (at_.load_gain < 0 ? 1.0 : parameters[at_.load_gain]) * data.load_Nm[i];
  if (fits_gravity_) sum += parameters[at_.gravity] * at.cos_q + parameters[at_.gravity + 1] * at.sin_q;
  return sum;
}

double JointModel::beside_load(const Regressors& at, const JointDataset& data,
                               const Eigen::VectorXd& parameters, Index i) const {
  double sum = parameters[kInertia] * data.acceleration_rad_s2[i] + parameters[at_.offset];
  for (std::size_t k = 0; k < harmonics_.size(); ++k) {
    const Index p = at_.ripple + 2 * static_cast<Index>(k);
    sum += parameters[p] * at.ripple[k].real() + parameters[p + 1] * at.ripple[k].imag();
  }
  return sum;
}

void JointModel::fill_row(const Regressors& at, const JointDataset& data, Index i,
                          const FrictionValue& friction, Eigen::MatrixXd& jacobian) const {
  const double by_load = 1.0 + friction.by_load;
  jacobian(i, kInertia) = data.acceleration_rad_s2[i];
  if (fits_gravity_) {
    jacobian(i, at_.gravity) = by_load * at.cos_q;
    jacobian(i, at_.gravity + 1) = by_load * at.sin_q;
  }
  if (at_.load_gain >= 0) jacobian(i, at_.load_gain) = by_load * data.load_Nm[i];
  jacobian(i, at_.offset) = 1.0;
  for (std::size_t k = 0; k < friction_.size(); ++k)
    jacobian(
        i, at_.friction + static_cast<Index>(k)) = friction.gradient[static_cast<std::size_t>(friction_[k])];
  for (std::size_t k = 0; k < harmonics_.size(); ++k) {
    jacobian(i, at_.ripple + 2 * static_cast<Index>(k)) = at.ripple[k].real();
    jacobian(i, at_.ripple + 2 * static_cast<Index>(k) + 1) = at.ripple[k].imag();
  }
}

void JointModel::predict(const JointDataset& data, const Eigen::VectorXd& parameters,
                         Eigen::VectorXd& prediction, Eigen::MatrixXd* jacobian) const {
  const FrictionParameters law = friction(parameters);
  FrictionInputs inputs(data, has(terms_, JointTerm::kPresliding), law.presliding_rad);
  prediction.resize(data.size());
  if (jacobian != nullptr) jacobian->resize(data.size(), parameters.size());
  for (Index i = 0; i < data.size(); ++i) {
    const Regressors at = regressors(data, i);
    const double load_here = load(at, data, parameters, i);
    const FrictionInput in = inputs.at(i, load_here);
    prediction[i] = beside_load(at, data, parameters, i) + load_here;
    if (jacobian == nullptr) {
      prediction[i] += friction_torque_Nm(law, in);
      continue;
    }
    const FrictionValue f = evaluate(law, in);
    prediction[i] += f.torque_Nm;
    fill_row(at, data, i, f, *jacobian);
  }
}

Eigen::VectorXd JointModel::gear_output(const JointDataset& data, const Eigen::VectorXd& parameters) const {
  const FrictionParameters law = friction(parameters);
  FrictionInputs inputs(data, has(terms_, JointTerm::kPresliding), law.presliding_rad);
  Eigen::VectorXd out(data.size());
  for (Index i = 0; i < data.size(); ++i) {
    const double available = data.measured_torque[i] - beside_load(regressors(data, i), data, parameters, i);
    out[i] = solve_gear_output(law, available, inputs.at(i, 0.0)).torque_Nm;
  }
  return out;
}

}  // namespace sprung::identification
