#include "tools/lab/recordings/recording_rows.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace sprung::recordings {
namespace {

/// Held-out R2 that is known to be within reach; joints that are not named are only reported.
struct KnownJoint {
  const char* recording;
  double least_r2;
};
constexpr KnownJoint kKnown[] = {
    {"ur10e joint 1", 0.9940}, {"ur10e joint 2", 0.9986}, {"ur10e joint 5", 0.9860}};

constexpr double kMostLinkRms_Nm = 3.6;
constexpr double kMostParameters = 14.0, kMostWithLoad = 8.0;
/// The tool's choice may not be further than this behind the plain Stribeck fit.
constexpr double kBehindStribeck = 0.0005;

std::string prefix_of(const std::string& recording) {
  std::string out = "estimator." + recording + ".";
  std::replace(out.begin(), out.end(), ' ', '_');
  return out;
}

bool load_known(const RecordingResult& result) { return !std::isnan(result.models.front().link_rms_Nm); }

double score(const RecordingResult& result, const ModelScore& model) {
  return load_known(result) ? model.link_rms_Nm : model.r2;
}

/// "viscous+load" -> "model_viscous_load"
std::string row_of_model(const std::string& model) {
  std::string out = "model_" + model;
  std::replace(out.begin(), out.end(), '+', '_');
  return out;
}

ReportRow main_row(const RecordingResult& result) {
  const bool link = load_known(result);
  Bounds bounds = demanded(link, at_most(kMostLinkRms_Nm));
  for (const KnownJoint& known : kKnown) {
    if (result.recording == known.recording) bounds.low = known.least_r2;
  }
  return row(prefix_of(result.recording) + (link ? "rms" : "r2"), link ? "Nm" : "",
             score(result, result.chosen()), bounds);
}

}  // namespace

std::vector<RecordingResult> results_of(const std::string& folder) {
  std::vector<RecordingResult> out;
  for (int joint = 1; joint <= 6; ++joint) {
    if (std::filesystem::exists(folder + "/ur10e/joint_" + std::to_string(joint) + ".csv"))
      out.push_back(result_of(ur10e_joint(folder, joint)));
  }
  if (std::filesystem::exists(folder + "/lara8/joint_3_sweep.csv"))
    out.push_back(result_of(lara8_joint_3(folder)));
  return out;
}

std::vector<ReportRow> rows_of(const RecordingResult& result) {
  const std::string prefix = prefix_of(result.recording);
  const bool link = load_known(result);
  std::vector<ReportRow> out = {main_row(result)};
  const auto add = [&](const std::string& name, const char* unit, double value, const Bounds& bounds = {}) {
    out.push_back(row(prefix + name, unit, value, bounds));
  };
  add("parameters", "", static_cast<double>(result.chosen().parameters),
      at_most(link ? kMostWithLoad : kMostParameters));
  for (const ModelScore& model : result.models) {
    const bool stribeck = model.model == "viscous+stribeck";
    const std::string name = model.model == "coulomb" ? "coulomb"
                             : stribeck               ? "stribeck"
                                                      : row_of_model(model.model);
    add(name, link ? "Nm" : "", score(result, model));
    if (stribeck && !link)
      add("ahead_of_stribeck", "", result.chosen().r2 - model.r2, at_least(-kBehindStribeck));
  }
  return out;
}

std::vector<ReportRow> rows_of(const FootprintScore& score) {
  return {row("estimator.lara8_footprint.without", "Nm", score.without_rms_Nm),
          row("estimator.lara8_footprint.with", "Nm", score.with_rms_Nm)};
}

}  // namespace sprung::recordings
