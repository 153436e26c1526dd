#include "tools/lab/identify/leg_comparison.h"

#include <cmath>
#include <cstdio>

#include "model/leg_kinematics.h"
#include "signals/angles.h"
#include "tools/lab/identify/drive_series.h"

namespace sprung::identify {

namespace {

constexpr double kLeastWeight_Nm = 1.0;
constexpr double kClear = 5.0;         ///< standard errors
constexpr double kAlikeShares = 0.01;  ///< of the torque constant, by shares that are alike to 0.02

/// One joint of a leg whose other joints hold a pose.
struct HeldLeg {
  std::unique_ptr<LegKinematics> kinematics;  ///< null: joints alone
  JointVector pose_rad;
  int place;

  double links_kg_m2() const {
    const JointVector still = JointVector::Zero(pose_rad.size());
    JointVector one = still;
    one[place] = 1.0;
    return kinematics->inverse_dynamics_Nm(pose_rad, still, one)[place] -
           kinematics->inverse_dynamics_Nm(pose_rad, still, still)[place];
  }
  double weight_Nm(double angle_rad) const {
    JointVector turned_rad = pose_rad;
    turned_rad[place] = angle_rad;
    return kinematics->gravity_torque_Nm(turned_rad)[place];
  }
};

HeldLeg held_leg(const RobotConfig& robot, int joint, const std::vector<double>& pose_rad) {
  const LegPlace at = place_of(robot, joint);
  HeldLeg out{make_leg_kinematics(robot.legs[at.leg]), JointVector(), at.place};
  out.pose_rad = Eigen::Map<const Eigen::VectorXd>(pose_rad.data(),
                                                   static_cast<Eigen::Index>(pose_rad.size()));
  return out;
}

struct Known {
  double value = 0.0;
  double standard_error = 0.0;
};

std::optional<Known> parameter(const identification::ModelResult& model, const std::string& name) {
  const auto& all = model.model->parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (all[i].name == name) return Known{model.fit.parameters[at], model.statistics.standard_error[at]};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Weighed> weighed(const identification::ModelResult& model) {
  const std::optional<Known> gain = parameter(model, "load_gain");
  if (!gain || !(gain->value > kClear * gain->standard_error)) return std::nullopt;
  const double driving = gain->value * (1.0 + parameter(model, "load_share_driving").value_or(Known{}).value);
  const double driven = gain->value * (1.0 - parameter(model, "load_share_driven").value_or(Known{}).value);
  const double both = 0.5 * (driving + driven);
  const double error = std::hypot(gain->standard_error, kAlikeShares * gain->value);
  return Weighed{{1.0 / both, error / (both * both), true}, (driving - driven) / (driving + driven)};
}

std::optional<Armature> armature_of(const RobotConfig& robot, int joint, const std::vector<double>& pose_rad,
                                    const identification::ModelResult& model) {
  const HeldLeg leg = held_leg(robot, joint, pose_rad);
  const std::optional<Known> inertia = parameter(model, "inertia");
  if (!leg.kinematics || !inertia) return std::nullopt;
  Armature out;
  out.links_kg_m2 = leg.links_kg_m2();
  const double true_share = weighed(model).value_or(Weighed{}).torque_constant.factor;
  out.value_kg_m2 = true_share * inertia->value - out.links_kg_m2;
  out.standard_error_kg_m2 = true_share * inertia->standard_error;
  char text[200];
  std::snprintf(
      text, sizeof text,
      "fitted inertia %.6g kg m^2 less %.6g kg m^2 of the links about this joint at the recorded pose, by "
      "robot.yaml's masses",
      true_share * inertia->value, out.links_kg_m2);
  out.note = text;
  return out;
}

std::optional<TorqueConstant> torque_constant_of(const RobotConfig& robot, int joint,
                                                 const std::vector<double>& pose_rad,
                                                 const identification::ModelResult& model) {
  if (const auto found = weighed(model)) return found->torque_constant;
  const HeldLeg leg = held_leg(robot, joint, pose_rad);
  const auto fitted_cos = parameter(model, "gravity_cos"), fitted_sin = parameter(model, "gravity_sin");
  if (!leg.kinematics || !fitted_cos || !fitted_sin) return std::nullopt;
  // One joint alone: cosine, sine and a constant of its angle.
  const double constant = (leg.weight_Nm(0.0) + leg.weight_Nm(kPi)) / 2.0;
  const double cosine = leg.weight_Nm(0.0) - constant, sine = leg.weight_Nm(kPi / 2.0) - constant;
  const double known = std::hypot(cosine, sine);
  if (known < kLeastWeight_Nm) return std::nullopt;
  const double found = (fitted_cos->value * cosine + fitted_sin->value * sine) / known;
  const double error = std::hypot(fitted_cos->standard_error * cosine, fitted_sin->standard_error * sine) /
                       known;
  if (!(found > kClear * error)) return std::nullopt;
  return TorqueConstant{known / found, known / found * error / found};
}

}  // namespace sprung::identify
