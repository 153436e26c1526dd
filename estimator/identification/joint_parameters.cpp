#include "estimator/identification/joint_parameters.h"

#include <cmath>

namespace sprung::identification {
namespace {

using P = FrictionParameter;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Wide enough for any gear (0.5-1 mrad, facts papers D3), and away from zero, where the derivative ends.
constexpr double kLeastPresliding_rad = 1e-6;
constexpr double kMostPresliding_rad = 0.05;
/// Gears have 0.15 to 2.8 rad/s (facts papers C4), UR10e's joint 5 0.04. Below this a fit describes samples
/// whose smoothing reaches into a stop: breakaway 37 Nm at 4 mrad/s for a plant with 7.3, 10.8 Nm at 15
/// mrad/s for one with 5.6. Such a fit ends here, and counts as not supported.
constexpr double kLeastStribeckSpeed_rad_s = 0.03;
/// Gears differ by 0.05 to 0.1 between the directions (facts papers C4). More is an offset that was mistaken
/// for friction.
constexpr double kMostAsymmetry = 0.2;

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
  if (parameter == P::kAsymmetry) {
    out.lower = -kMostAsymmetry;
    out.upper = kMostAsymmetry;
  }
  if (parameter == P::kStribeckSpeed) out.lower = kLeastStribeckSpeed_rad_s;
  out.more_starts = more_starts_of(parameter, scales);
  out.told_by = told_by(parameter);
  return out;
}

/// A parameter that may have any value.
FitParameter free_parameter(const std::string& name, const std::string& unit, double initial,
                            const std::string& told_by) {
  return {name, unit, initial, -kInfinity, kInfinity, {}, told_by};
}

FitParameter positive_parameter(const std::string& name, const std::string& unit, double initial,
                                const std::string& told_by) {
  return {name, unit, initial, 0.0, kInfinity, {}, told_by};
}

}  // namespace

std::vector<FitParameter> joint_parameters(const JointTerms& terms, const JointDataset& data) {
  const std::string& unit = data.torque_unit;
  const bool newton = unit == "Nm";
  const Scales scales = scales_of(data);
  std::vector<FitParameter> out = {positive_parameter("inertia", newton ? "kg m^2" : unit + " s^2/rad",
                                                      0.1 * scales.torque, "fast changes of speed")};
  if (!data.has_load() || data.load_beside_own) {
    for (const char* part : {"gravity_cos", "gravity_sin"})
      out.push_back(free_parameter(part, unit, 0.1 * scales.torque, "positions far from each other"));
  }
  if (has(terms, JointTerm::kLoadGain))
    out.push_back(positive_parameter("load_gain", newton ? "" : unit + "/Nm", 1.0, "different loads"));
  out.push_back(free_parameter("offset", unit, 0.0, "motion in both directions"));
  for (const P parameter : friction_of(terms)) out.push_back(friction_parameter(parameter, scales, unit));
  for (const int harmonic : ripple_harmonics(terms)) {
    for (const char* part : {"_cos", "_sin"})
      out.push_back(
          free_parameter("ripple_" + std::to_string(harmonic) + part, unit, 0.0, "slow steady motion"));
  }
  return out;
}

}  // namespace sprung::identification
