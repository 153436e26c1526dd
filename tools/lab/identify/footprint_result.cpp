#include "tools/lab/identify/footprint_result.h"

#include <cstdio>
#include <stdexcept>

#include "tools/lab/identify/result_table.h"

namespace sprung::identify {

using identification::FitPiece;
using identification::FitProblem;
using identification::FootprintModel;
using identification::FootprintTerms;

namespace {

/// The recordings with their load filled in where it is not known.
std::vector<FitPiece> loaded(std::vector<FitPiece> pieces, const identification::ModelResult& model) {
  for (FitPiece& piece : pieces) {
    if (!piece.data.has_link_position())
      throw std::invalid_argument(
          "--footprint needs a second encoder: a column link_position, or link encoders in "
          "robot.yaml");
    if (piece.data.torque_unit != "Nm")
      throw std::invalid_argument("--footprint needs torques in Nm: give --torque-constant");
    if (!piece.data.has_load() || piece.data.load_beside_own)
      piece.data.load_Nm = model.model->gear_output(piece.data, model.fit.parameters);
  }
  return pieces;
}

std::vector<FitPiece> differences(std::vector<FitPiece> pieces) {
  for (FitPiece& piece : pieces) piece.data = identification::encoder_difference(piece.data);
  return pieces;
}

/// Torque from both encoders against the load, over the samples that count.
double torque_rms_Nm(const FootprintModel& model, const std::vector<FitPiece>& pieces,
                     const Eigen::VectorXd& x) {
  double sum = 0.0, count = 0.0;
  for (const FitPiece& piece : pieces) {
    const Eigen::ArrayXd error = (model.torque_Nm(piece.data, x) - piece.data.load_Nm).array();
    sum += (piece.weight.array() * error.square()).sum();
    count += piece.weight.sum();
  }
  return std::sqrt(sum / count);
}

FootprintFit fitted(const FootprintModel& model, const std::vector<FitPiece>& training,
                    const std::vector<FitPiece>& test, const identification::FitOptions& options) {
  FootprintFit out;
  const std::vector<FitPiece> from = differences(training), scored = differences(test);
  const FitProblem problem(model, from);
  out.name = model.name();
  out.parameters = model.parameters();
  out.fit = identification::fit(problem, options);
  out.statistics = identification::statistics(problem, out.fit);
  out.held_out = identification::score(FitProblem(model, scored), out.fit.parameters);
  out.held_out_torque_rms_Nm = torque_rms_Nm(model, test, out.fit.parameters);
  out.stiffness_Nm_rad = model.stiffness_Nm_rad(out.fit.parameters);
  return out;
}

}  // namespace

FootprintResult footprint_of(const IdentifiedJoint& joint, const identification::FitOptions& options) {
  const std::vector<FitPiece> training = loaded(joint.result.training, joint.chosen());
  const std::vector<FitPiece> test = loaded(joint.result.test, joint.chosen());
  FootprintTerms plain;
  plain.motor_harmonics.clear();
  plain.link_harmonics.clear();
  return {fitted(FootprintModel(plain), training, test, options),
          fitted(FootprintModel(FootprintTerms{}), training, test, options)};
}

std::string footprint_table(const FootprintResult& result) {
  std::string text = "encoders' difference, held out:\n";
  char line[200];
  for (const FootprintFit& one : result) {
    std::snprintf(line, sizeof line,
                  "  %-12s %8.2f urad RMS, %8.3g Nm RMS as torque, stiffness %.4g Nm/rad\n", one.name.c_str(),
                  1e6 * one.held_out.rms, one.held_out_torque_rms_Nm, one.stiffness_Nm_rad);
    text += line;
  }
  const FootprintFit& last = result.back();
  for (std::size_t i = 0; i < last.parameters.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    text += "  " + last.parameters[i].name + " " +
            with_error(last.fit.parameters[at], last.statistics.standard_error[at], last.parameters[i].unit) +
            "\n";
  }
  for (const std::string& warning : last.statistics.warnings) text += "  warning: " + warning + "\n";
  return text;
}

}  // namespace sprung::identify
