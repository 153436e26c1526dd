#include "tools/lab/identify/fragment.h"

#include <sha2.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>

#include "robots/identification_sections.h"
#include "tools/lab/identify/law_uncertainty.h"
#include "tools/lab/identify/leg_comparison.h"
#include "tools/lab/identify/result_table.h"

namespace sprung::identify {

using identification::has;
using identification::JointTerm;
using identification::JointTerms;
using identification::ModelResult;

namespace {

/// Below this a share of uncertainty is not believed, however small the standard error: Kt, temperature and
/// lubrication drift more, and a fit is only promised to be within 5 %.
constexpr double kLeastShare = 0.02;
/// Of a torque constant that was weighed: scale, lever and the current sensor's own gain.
constexpr double kLeastConstant = 0.01;

/// The simplest named model that allows these terms.
FrictionModelKind kind_of(const JointTerms& terms) {
  if (has(terms, JointTerm::kPresliding)) return FrictionModelKind::kPresliding;
  if (has(terms, JointTerm::kLoad) || has(terms, JointTerm::kAsymmetry)) return FrictionModelKind::kLoad;
  if (has(terms, JointTerm::kStribeck)) return FrictionModelKind::kStribeck;
  if (has(terms, JointTerm::kViscous)) return FrictionModelKind::kViscous;
  return FrictionModelKind::kCoulomb;
}

double standard_error_of(const ModelResult& model, const std::string& name) {
  const auto& all = model.model->parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].name == name) return model.statistics.standard_error[static_cast<Eigen::Index>(i)];
  }
  return 0.0;
}

std::string comment(const std::string& text) { return "    # " + text + "\n"; }

std::string other_parameters(const ModelResult& model) {
  std::string out;
  const auto& all = model.model->parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    std::string value = with_error(model.fit.parameters[at], model.statistics.standard_error[at],
                                   all[i].unit);
    value.erase(0, value.find_first_not_of(' '));
    out += comment(all[i].name + ": " + value);
  }
  return out;
}

std::string entry(const IdentifiedJoint& joint, const JointConfig& config) {
  char text[160];
  std::string out = "  - name: " + config.name + "\n";
  if (joint.armature) {
    std::snprintf(text, sizeof text, "    armature: %.6g kg m^2\n", config.armature_kg_m2);
    out += text + comment(joint.armature->note);
  } else {
    out += comment("armature: as it was; links are not known, so that rotor and link cannot be told apart");
  }
  out += identification_text(config);
  if (const auto corrected = corrected_torque_constant(joint)) {
    std::snprintf(text, sizeof text,
                  "its actuator's torque_constant: %.5g +- %.2g times what it was, by the "
                  "known weight",
                  corrected->factor, corrected->standard_error);
    out += comment(text);
    if (corrected->factor < 1.0)
      out += comment("its torque_limit as much lower: the motor's peak current stays what it was");
  }
  out += comment("model " + joint.chosen().model->name() + ", value +- standard error:");
  out += other_parameters(joint.chosen());
  for (const std::string& warning : joint.chosen().statistics.warnings) out += comment("warning: " + warning);
  return out;
}

}  // namespace

namespace {

/// A model whose torques were read with a wrong torque constant, with the right one.
void scale_torques(FrictionParameters& friction, double factor) {
  friction.coulomb_Nm *= factor;
  friction.stribeck_Nm *= factor;
  friction.viscous_Nm_s_rad *= factor;
}

double load_share_of(const ModelResult& model) {
  return has(model.model->terms(), JointTerm::kLoad) ? weighed(model).value_or(Weighed{}).load_share : 0.0;
}

}  // namespace

std::optional<TorqueConstant> corrected_torque_constant(const IdentifiedJoint& joint) {
  if (joint.torque_constant && joint.torque_constant->by_known_weight) return joint.torque_constant;
  return std::nullopt;
}

JointConfig identified_config(const IdentifiedJoint& joint, const JointConfig& known,
                              const Provenance& provenance, const OtherDays& days) {
  const ModelResult& model = joint.chosen();
  if (joint.result.training.front().data.torque_unit != "Nm")
    throw std::invalid_argument(
        "a fragment needs torques in Nm: give --torque-constant, or a column 'torque'");
  JointConfig out = known;
  IdentifiedFriction friction;
  friction.model = kind_of(model.model->terms());
  friction.parameters = model.model->friction(model.fit.parameters);
  if (!(friction.parameters.viscous_Nm_s_rad > 0.0)) friction.parameters.viscous_temperature_1_K = 0.0;
  const auto corrected = corrected_torque_constant(joint);
  if (corrected) {
    scale_torques(friction.parameters, corrected->factor);
    friction.parameters.load_share_driving = friction.parameters.load_share_driven = load_share_of(model);
    out.uncertainty.torque_constant = std::max(corrected->standard_error, kLeastConstant);
  }
  friction.record.date = provenance.date;
  friction.record.log = provenance.file;
  friction.record.sha256 = provenance.sha256;
  friction.record.samples = static_cast<std::int64_t>(model.train.samples);
  friction.record.held_out_r2 = model.held_out.r2;
  friction.record.held_out_rms_Nm = model.held_out.rms;
  friction.record.command = provenance.command;
  friction.record.temperature_C = provenance.temperature_C;
  friction.record.supply_V = provenance.supply_V;
  const bool tells_warmth = friction.parameters.viscous_temperature_1_K > 0.0;
  if (tells_warmth && std::isfinite(days.ambient_C))
    out.thermal = thermal_in_room(known.thermal, days.ambient_C);
  const bool known_warmth = tells_warmth && out.thermal.time_constant_s > 0.0;
  const double usual = known_warmth ? kDayToDayOfKnownWarmth : kDayToDay;
  out.uncertainty.friction = law_uncertainty(model, joint.result.training,
                                             std::isnan(days.friction) ? usual : days.friction);
  if (joint.armature && joint.armature->value_kg_m2 > 0.0) {
    out.armature_kg_m2 = joint.armature->value_kg_m2;
    const double share = standard_error_of(model, "inertia") / out.armature_kg_m2;
    out.uncertainty.armature = std::clamp(share, kLeastShare, 1.0);
  }
  out.friction = friction;
  return out;
}

std::string fragment_text(const std::vector<IdentifiedJoint>& joints,
                          const std::vector<JointConfig>& configs) {
  std::string out =
      "# Written by sprung identify: put the keys of each joint in the place of the same keys in "
      "robot.yaml.\njoints:\n";
  for (std::size_t i = 0; i < joints.size(); ++i) out += entry(joints[i], configs[i]);
  return out;
}

std::string short_sha256(const std::vector<std::string>& paths) {
  SHA2_CTX sum;
  SHA256Init(&sum);
  for (const std::string& path : paths) {
    std::ifstream in(path, std::ios::binary);
    if (!in) throw std::runtime_error("cannot read " + path + ": does it exist?");
    std::array<char, 1 << 16> part{};
    while (in.read(part.data(), part.size()) || in.gcount() > 0)
      SHA256Update(&sum, reinterpret_cast<const std::uint8_t*>(part.data()),
                   static_cast<std::size_t>(in.gcount()));
  }
  std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
  return std::string(SHA256End(&sum, text.data()), 16);
}

}  // namespace sprung::identify
