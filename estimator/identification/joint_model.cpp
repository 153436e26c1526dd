#include "estimator/identification/joint_model.h"

#include <cmath>
#include <stdexcept>

#include "estimator/coulomb_friction.h"
#include "estimator/friction/friction_law.h"
#include "estimator/friction/gear_output.h"
#include "estimator/friction/presliding_state.h"

namespace sprung::identification {
namespace {

using Index = Eigen::Index;
using P = FrictionParameter;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Without presliding the sign of motion is tanh(qd / this): a measured speed has a sign at rest, but it means nothing.
constexpr double kSignSmoothing_rad_s = kRestSpeed_rad_s;

/// Wide enough for any gear (0.5-1 mrad, facts papers D3), and away from zero, where the derivative ends.
constexpr double kLeastPresliding_rad = 1e-6;
constexpr double kMostPresliding_rad = 0.05;

struct Scales {
  double torque;
  double speed_rad_s;
};

Scales scales_of(const JointDataset& data) {
  const Eigen::ArrayXd centred = data.measured_torque.array() - data.measured_torque.mean();
  const double torque = std::sqrt(centred.square().mean());
  const double speed_rad_s = data.velocity_rad_s.cwiseAbs().maxCoeff();
  return {torque > 0.0 ? torque : 1.0, speed_rad_s > 0.0 ? speed_rad_s : 1.0};
}

/// "Nm s/rad" in amperes is "A s/rad".
std::string in_unit(std::string unit, const std::string& torque_unit) {
  const std::size_t at = unit.find("Nm");
  return at == std::string::npos ? unit : unit.replace(at, 2, torque_unit);
}

double initial_of(P parameter, const Scales& scales) {
  switch (parameter) {
    case P::kCoulomb:
      return 0.3 * scales.torque;
    case P::kStribeck:
      return 0.1 * scales.torque;
    case P::kStribeckSpeed:
      return 0.3 * scales.speed_rad_s;
    case P::kViscous:
      return 0.3 * scales.torque / scales.speed_rad_s;
    case P::kViscousExponent:
      return 0.8;
    case P::kLoadShareDriving:
    case P::kLoadShareDriven:
      return 0.05;
    case P::kPresliding:
      return 5e-4;
    default:
      return info(parameter).off;
  }
}

std::vector<double> more_starts_of(P parameter, const Scales& scales) {
  if (parameter == P::kStribeckSpeed) return {0.03 * scales.speed_rad_s};
  if (parameter == P::kPresliding) return {5e-5, 5e-3};
  return {};
}

const char* told_by(P parameter) {
  switch (parameter) {
    case P::kStribeck:
    case P::kStribeckSpeed:
      return "slow and fast motion in both directions";
    case P::kViscous:
    case P::kViscousExponent:
      return "different speeds";
    case P::kLoadShareDriving:
    case P::kLoadShareDriven:
      return "the joint loaded both ways, driving and driven back";
    case P::kPresliding:
      return "slow reversals";
    case P::kViscousTemperature:
      return "the same motion cold and warm";
    default:
      return "motion in both directions";
  }
}

FitParameter friction_parameter(P parameter, const Scales& scales, const std::string& torque_unit) {
  const FrictionParameterInfo& i = info(parameter);
  FitParameter out{i.name, in_unit(i.unit, torque_unit), initial_of(parameter, scales), i.low, i.high};
  if (parameter == P::kPresliding) {
    out.lower = kLeastPresliding_rad;
    out.upper = kMostPresliding_rad;
  }
  out.more_starts = more_starts_of(parameter, scales);
  out.told_by = told_by(parameter);
  return out;
}

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
      load_known_(data.has_load()) {
  check(terms, data);
  add_rigid_body(data);
  add_friction(data);
  add_ripple(data);
}

void JointModel::add_rigid_body(const JointDataset& data) {
  const std::string& unit = data.torque_unit;
  const Scales scales = scales_of(data);
  const auto next = [this] { return static_cast<Index>(parameters_.size()); };
  parameters_.push_back({"inertia",
                         unit == "Nm" ? "kg m^2" : unit + " s^2/rad",
                         0.1 * scales.torque,
                         0.0,
                         kInfinity,
                         {},
                         "fast changes of speed"});
  if (!load_known_) {
    at_.gravity = next();
    for (const char* part : {"gravity_cos", "gravity_sin"})
      parameters_.push_back(
          {part, unit, 0.1 * scales.torque, -kInfinity, kInfinity, {}, "positions far from each other"});
  }
  if (has(terms_, JointTerm::kLoadGain)) {
    at_.load_gain = next();
    parameters_.push_back(
        {"load_gain", unit == "Nm" ? "" : unit + "/Nm", 1.0, 0.0, kInfinity, {}, "different loads"});
  }
  at_.offset = next();
  parameters_.push_back({"offset", unit, 0.0, -kInfinity, kInfinity, {}, "motion in both directions"});
}

void JointModel::add_friction(const JointDataset& data) {
  at_.friction = static_cast<Index>(parameters_.size());
  const Scales scales = scales_of(data);
  for (const P parameter : friction_)
    parameters_.push_back(friction_parameter(parameter, scales, data.torque_unit));
}

void JointModel::add_ripple(const JointDataset& data) {
  at_.ripple = static_cast<Index>(parameters_.size());
  for (const int harmonic : harmonics_) {
    for (const char* part : {"_cos", "_sin"})
      parameters_.push_back({"ripple_" + std::to_string(harmonic) + part,
                             data.torque_unit,
                             0.0,
                             -kInfinity,
                             kInfinity,
                             {},
                             "slow steady motion"});
  }
}

FrictionParameters JointModel::friction(const Eigen::VectorXd& parameters) const {
  FrictionParameters out;
  for (std::size_t k = 0; k < friction_.size(); ++k)
    out.*(info(friction_[k]).member) = parameters[at_.friction + static_cast<Index>(k)];
  return out;
}

double JointModel::load_at(const JointDataset& data, const Eigen::VectorXd& parameters, Index i) const {
  if (load_known_) return (at_.load_gain < 0 ? 1.0 : parameters[at_.load_gain]) * data.load_Nm[i];
  const double q = data.position_rad[i];
  return parameters[at_.gravity] * std::cos(q) + parameters[at_.gravity + 1] * std::sin(q);
}

double JointModel::ripple_at(const JointDataset& data, const Eigen::VectorXd& parameters, Index i) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < harmonics_.size(); ++k) {
    const double angle = harmonics_[k] * data.gear_ratio * data.position_rad[i];
    const Index at = at_.ripple + 2 * static_cast<Index>(k);
    sum += parameters[at] * std::cos(angle) + parameters[at + 1] * std::sin(angle);
  }
  return sum;
}

void JointModel::fill_row(const JointDataset& data, Index i, double by_load,
                          Eigen::MatrixXd& jacobian) const {
  const double q = data.position_rad[i];
  jacobian(i, 0) = data.acceleration_rad_s2[i];
  if (!load_known_) {
    jacobian(i, at_.gravity) = by_load * std::cos(q);
    jacobian(i, at_.gravity + 1) = by_load * std::sin(q);
  }
  if (at_.load_gain >= 0) jacobian(i, at_.load_gain) = by_load * data.load_Nm[i];
  jacobian(i, at_.offset) = 1.0;
  for (std::size_t k = 0; k < harmonics_.size(); ++k) {
    const double angle = harmonics_[k] * data.gear_ratio * q;
    jacobian(i, at_.ripple + 2 * static_cast<Index>(k)) = std::cos(angle);
    jacobian(i, at_.ripple + 2 * static_cast<Index>(k) + 1) = std::sin(angle);
  }
}

void JointModel::predict(const JointDataset& data, const Eigen::VectorXd& parameters,
                         Eigen::VectorXd& prediction, Eigen::MatrixXd* jacobian) const {
  const FrictionParameters law = friction(parameters);
  FrictionInputs inputs(data, has(terms_, JointTerm::kPresliding), law.presliding_rad);
  prediction.resize(data.size());
  if (jacobian != nullptr) jacobian->resize(data.size(), parameters.size());
  for (Index i = 0; i < data.size(); ++i) {
    const double load = load_at(data, parameters, i);
    const FrictionInput in = inputs.at(i, load);
    prediction[i] = parameters[0] * data.acceleration_rad_s2[i] + load + parameters[at_.offset] +
                    ripple_at(data, parameters, i);
    if (jacobian == nullptr) {
      prediction[i] += friction_torque_Nm(law, in);
      continue;
    }
    const FrictionValue f = evaluate(law, in);
    prediction[i] += f.torque_Nm;
    fill_row(data, i, 1.0 + f.by_load, *jacobian);
    for (std::size_t k = 0; k < friction_.size(); ++k)
      (*jacobian)(i, at_.friction + static_cast<Index>(k)) =
          f.gradient[static_cast<std::size_t>(friction_[k])];
  }
}

Eigen::VectorXd JointModel::gear_output(const JointDataset& data, const Eigen::VectorXd& parameters) const {
  const FrictionParameters law = friction(parameters);
  FrictionInputs inputs(data, has(terms_, JointTerm::kPresliding), law.presliding_rad);
  Eigen::VectorXd out(data.size());
  for (Index i = 0; i < data.size(); ++i) {
    const double available = data.measured_torque[i] - parameters[0] * data.acceleration_rad_s2[i] -
                             parameters[at_.offset] - ripple_at(data, parameters, i);
    out[i] = solve_gear_output(law, available, inputs.at(i, 0.0)).torque_Nm;
  }
  return out;
}

}  // namespace sprung::identification
