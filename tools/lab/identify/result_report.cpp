#include "tools/lab/identify/result_report.h"

#include <cmath>

#include "tools/lab/identify/result_table.h"

namespace sprung::identify {

using identification::FitPiece;
using identification::ModelResult;
using report::Plot;
using report::Section;
using report::Style;
using report::Table;

namespace {

/// What is drawn, of every scored sample.
struct Drawn {
  std::vector<double> time_s, position_rad, speed_rad_s, load, friction, fit, residual;
};

/// The same parameters with every friction term off.
Eigen::VectorXd without_friction(const ModelResult& model) {
  Eigen::VectorXd out = model.fit.parameters;
  const auto& all = model.model->parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (const char* name : {"coulomb", "stribeck", "viscous", "load_share_driving", "load_share_driven"}) {
      if (all[i].name == name) out[static_cast<Eigen::Index>(i)] = 0.0;
    }
  }
  return out;
}

void add(const FitPiece& piece, const ModelResult& model, Drawn& out) {
  const auto& data = piece.data;
  Eigen::VectorXd whole, rigid;
  model.model->predict(data, model.fit.parameters, whole, nullptr);
  model.model->predict(data, without_friction(model), rigid, nullptr);
  const Eigen::VectorXd load = model.model->gear_output(data, model.fit.parameters);
  for (Eigen::Index i = 0; i < data.size(); ++i) {
    if (piece.weight[i] == 0.0) continue;
    out.time_s.push_back(data.time_s[i]);
    out.position_rad.push_back(data.position_rad[i]);
    out.speed_rad_s.push_back(data.velocity_rad_s[i]);
    out.load.push_back(load[i]);
    out.friction.push_back(data.measured_torque[i] - rigid[i]);
    out.fit.push_back(whole[i] - rigid[i]);
    out.residual.push_back(whole[i] - data.measured_torque[i]);
  }
}

Table models_table(const IdentifiedJoint& joint, const std::string& unit) {
  Table out{"Models",
            {"model", "parameters", "R2, left-out blocks", "R2, held out", "RMS, held out (" + unit + ")"},
            {}};
  for (const ModelResult& model : joint.result.models) {
    const auto mark = &model == &joint.chosen() ? report::Mark::kGood : report::Mark::kPlain;
    out.rows.push_back({{model.model->name(), mark},
                        model.free_parameters,
                        model.validation.r2(),
                        model.held_out.r2,
                        model.held_out.rms});
  }
  out.note = joint.result.why + ".";
  return out;
}

Table parameters_table(const ModelResult& model) {
  Table out{"Parameters of " + model.model->name(), {"parameter", "value", "standard error", "unit"}, {}};
  const auto& all = model.model->parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    out.rows.push_back(
        {all[i].name, model.fit.parameters[at], model.statistics.standard_error[at], all[i].unit});
  }
  return out;
}

Plot friction_plot(const Drawn& d, const std::string& unit) {
  return {"Friction over speed: what inertia, weight, offset and ripple leave",
          {"speed", "rad/s"},
          {"friction", unit},
          {{"measured", d.speed_rad_s, d.friction, Style::kPoints, 0},
           {"fit", d.speed_rad_s, d.fit, Style::kPoints, 1}}};
}

Plot residual_plot(const char* over, const report::Axis& axis, const std::vector<double>& x, const Drawn& d,
                   const std::string& unit, Style style) {
  return {std::string("Residual over ") + over,
          axis,
          {"fit - measured", unit},
          {{"residual", x, d.residual, style, 0}}};
}

Section section_of(const IdentifiedJoint& joint) {
  const std::string unit = joint.result.training.front().data.torque_unit;
  Drawn d;
  for (const FitPiece& piece : joint.result.test) add(piece, joint.chosen(), d);
  Section out;
  out.heading = joint.name.empty() ? "Joint" : "Joint " + joint.name;
  out.text = joint.notes;
  if (joint.armature)
    out.text.push_back(
        "armature " +
        with_error(joint.armature->value_kg_m2, joint.armature->standard_error_kg_m2, "kg m^2") + ": " +
        joint.armature->note);
  for (const std::string& warning : joint.chosen().statistics.warnings)
    out.text.push_back("Warning: " + warning);
  out.text.push_back(std::string("Rule: ") + identification::selection_criterion() + ".");
  out.tables = {models_table(joint, unit), parameters_table(joint.chosen())};
  out.plots = {friction_plot(d, unit), residual_plot("time", {"time", "s"}, d.time_s, d, unit, Style::kLine),
               residual_plot("speed", {"speed", "rad/s"}, d.speed_rad_s, d, unit, Style::kPoints),
               residual_plot("load", {"gear output torque", unit}, d.load, d, unit, Style::kPoints),
               residual_plot("position", {"position", "rad"}, d.position_rad, d, unit, Style::kPoints)};
  return out;
}

}  // namespace

report::Report result_report(const std::vector<IdentifiedJoint>& joints, const Provenance& provenance) {
  report::Report out;
  out.title = "Identification of " + provenance.file;
  out.subtitle = provenance.date + ", SHA-256 " + provenance.sha256;
  out.command = provenance.command;
  for (const IdentifiedJoint& joint : joints) out.sections.push_back(section_of(joint));
  return out;
}

}  // namespace sprung::identify
