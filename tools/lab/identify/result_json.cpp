#include "tools/lab/identify/result_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace sprung::identify {

using identification::FitParameter;
using identification::JointResult;
using identification::ModelResult;
using Json = nlohmann::ordered_json;

namespace {

Json json_number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json parameters_of(const std::vector<FitParameter>& all, const identification::Fit& fit,
                   const identification::FitStatistics& statistics) {
  Json out = Json::object();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    out[all[i].name] = {{"value", json_number(fit.parameters[at])},
                        {"unit", all[i].unit},
                        {"standard_error", json_number(statistics.standard_error[at])},
                        {"at_bound", static_cast<bool>(fit.at_bound[i])}};
  }
  return out;
}

/// Rows and columns in order of the parameters.
Json correlations_of(const ModelResult& model) {
  Json out = Json::array();
  for (const auto& row : model.statistics.correlation.rowwise()) {
    Json line = Json::array();
    for (const double value : row) line.push_back(json_number(value));
    out.push_back(line);
  }
  return out;
}

Json model_json(const ModelResult& model) {
  return {{"name", model.model->name()},
          {"free_parameters", model.free_parameters},
          {"parameters", parameters_of(model.model->parameters(), model.fit, model.statistics)},
          {"correlations", correlations_of(model)},
          {"held_out_r2", json_number(model.held_out.r2)},
          {"held_out_rms", json_number(model.held_out.rms)},
          {"train_r2", json_number(model.train.r2)},
          {"train_rms", json_number(model.train.rms)},
          {"cross_validation_r2", json_number(model.validation.r2())},
          {"effective_samples", json_number(model.statistics.effective_samples)},
          {"warnings", model.statistics.warnings}};
}

Json armature_json(const std::optional<Armature>& armature) {
  if (!armature) return nullptr;
  return {{"value", json_number(armature->value_kg_m2)},
          {"unit", "kg m^2"},
          {"standard_error", json_number(armature->standard_error_kg_m2)},
          {"links", json_number(armature->links_kg_m2)},
          {"note", armature->note}};
}

Json torque_constant_json(const std::optional<TorqueConstant>& found) {
  if (!found) return nullptr;
  return {{"value", json_number(found->factor)}, {"standard_error", json_number(found->standard_error)}};
}

Json footprint_json(const FootprintResult& footprint) {
  Json out = Json::array();
  for (const FootprintFit& one : footprint)
    out.push_back({{"name", one.name},
                   {"parameters", parameters_of(one.parameters, one.fit, one.statistics)},
                   {"held_out_rms_rad", json_number(one.held_out.rms)},
                   {"held_out_torque_rms_Nm", json_number(one.held_out_torque_rms_Nm)},
                   {"stiffness_Nm_rad", json_number(one.stiffness_Nm_rad)},
                   {"warnings", one.statistics.warnings}});
  return out;
}

Json joint_json(const IdentifiedJoint& joint) {
  const JointResult& result = joint.result;
  Json out;
  out["joint"] = joint.name.empty() ? Json(nullptr) : Json(joint.name);
  out["torque_unit"] = result.training.front().data.torque_unit;
  out["rate_Hz"] = json_number(1.0 / result.training.front().data.period_s);
  out["window_s"] = {json_number(result.from_s), json_number(result.to_s)};
  out["samples"] = {{"train", joint.chosen().train.samples}, {"test", joint.chosen().held_out.samples}};
  out["chosen"] = joint.chosen().model->name();
  out["criterion"] = identification::selection_criterion();
  out["why"] = result.why;
  out["armature"] = armature_json(joint.armature);
  out["torque_constant_factor"] = torque_constant_json(joint.torque_constant);
  if (!joint.footprint.empty()) out["footprint"] = footprint_json(joint.footprint);
  out["notes"] = joint.notes;
  out["models"] = Json::array();
  for (const ModelResult& model : result.models) out["models"].push_back(model_json(model));
  return out;
}

}  // namespace

std::string result_json(const std::vector<IdentifiedJoint>& joints, const Provenance& provenance) {
  Json out;
  out["file"] = provenance.file;
  out["sha256"] = provenance.sha256;
  out["date"] = provenance.date;
  out["command"] = provenance.command;
  if (joints.size() == 1) out.update(joint_json(joints.front()));
  if (joints.size() > 1) {
    out["joints"] = Json::array();
    for (const IdentifiedJoint& joint : joints) out["joints"].push_back(joint_json(joint));
  }
  return out.dump(1);
}

}  // namespace sprung::identify
