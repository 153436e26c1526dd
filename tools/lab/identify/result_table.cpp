#include "tools/lab/identify/result_table.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace sprung::identify {

using identification::ModelResult;

namespace {

__attribute__((format(printf, 1, 2))) std::string line(const char* format, ...) {
  char text[400];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  return text;
}

std::string models_text(const IdentifiedJoint& joint, const std::string& unit) {
  std::string text = line("  %-44s %10s %12s %12s %12s\n", "model", "parameters", "left-out R2",
                          "held-out R2", ("RMS, " + unit).c_str());
  for (const ModelResult& model : joint.result.models) {
    text += line("%s %-44s %10d %12.5f %12.5f %12.5g\n", &model == &joint.chosen() ? "*" : " ",
                 model.model->name().c_str(), model.free_parameters, model.validation.r2(), model.held_out.r2,
                 model.held_out.rms);
  }
  return text;
}

std::string parameters_text(const ModelResult& model) {
  std::string text;
  const auto& all = model.model->parameters();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    text += line(
        "  %-22s %s%s\n", all[i].name.c_str(),
        with_error(model.fit.parameters[at], model.statistics.standard_error[at], all[i].unit).c_str(),
        model.fit.at_bound[i] ? "  (on its bound)" : "");
  }
  return text;
}

/// What a robot's own numbers add.
std::string robot_table(const IdentifiedJoint& joint) {
  std::string text;
  if (joint.armature) {
    text += line("  %-22s ", "armature") +
            with_error(joint.armature->value_kg_m2, joint.armature->standard_error_kg_m2, "kg m^2") +
            "\n    " + joint.armature->note + "\n";
  }
  if (joint.torque_constant) {
    text += line("  %-22s ", "torque constant") +
            with_error(joint.torque_constant->factor, joint.torque_constant->standard_error,
                       joint.torque_constant->by_known_weight ? "of robot.yaml's, by the known weight"
                                                              : "of robot.yaml's, if its masses are right") +
            "\n";
  }
  return text;
}

}  // namespace

std::string with_error(double value, double standard_error, const std::string& unit) {
  const std::string after = unit.empty() ? "" : " " + unit;
  if (!(standard_error > 0.0)) return line("%12.6g", value) + after;
  // Two digits of the standard error.
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(standard_error))));
  return line("%12.*f +- %.*f", decimals, value, decimals, standard_error) + after;
}

std::string result_table(const IdentifiedJoint& joint) {
  const auto& result = joint.result;
  const ModelResult& chosen = joint.chosen();
  const auto& data = result.training.front().data;
  std::string text;
  if (!joint.name.empty()) text += "joint " + joint.name + "\n";
  text += line("%ld samples fitted and %ld scored at %.6g Hz, %.6g to %.6g s\n\n",
               static_cast<long>(chosen.train.samples), static_cast<long>(chosen.held_out.samples),
               1.0 / data.period_s, result.from_s, result.to_s);
  text += models_text(joint, data.torque_unit);
  text += "\n* chosen: " + result.why + ".\n  Rule: " + identification::selection_criterion() + ".\n\n";
  text += "parameters of '" + chosen.model->name() + "' +- standard error\n" + parameters_text(chosen);
  text += robot_table(joint);
  for (const std::string& note : joint.notes) text += "note: " + note + "\n";
  for (const std::string& warning : chosen.statistics.warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace sprung::identify
