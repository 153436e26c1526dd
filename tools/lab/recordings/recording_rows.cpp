#include "tools/lab/recordings/recording_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "estimator/identification/fit_problem.h"
#include "estimator/identification/footprint.h"

namespace sprung::recordings {

namespace {

using namespace identification;  // NOLINT: this file is about nothing else
using Index = Eigen::Index;

/// Root mean square of differences where the weight is not zero.
class WeightedRms {
 public:
  void add(const Eigen::VectorXd& difference, const Eigen::VectorXd& weight) {
    for (Index i = 0; i < difference.size(); ++i) {
      if (weight[i] == 0.0) continue;
      sum_ += difference[i] * difference[i];
      ++count_;
    }
  }
  double value() const {
    return count_ == 0 ? std::numeric_limits<double>::quiet_NaN()
                       : std::sqrt(sum_ / static_cast<double>(count_));
  }

 private:
  double sum_ = 0.0;
  long count_ = 0;
};

double link_rms_Nm(const ModelResult& model, const std::vector<FitPiece>& test) {
  WeightedRms rms;
  for (const FitPiece& piece : test) {
    if (piece.data.has_load() && piece.data.torque_unit == "Nm")
      rms.add(model.model->gear_output(piece.data, model.fit.parameters) - piece.data.load_Nm, piece.weight);
  }
  return rms.value();
}

/// Share of the scored samples within the bound that the training part has shown.
double covered(const ModelResult& model, const std::vector<FitPiece>& test) {
  Eigen::VectorXd residual;
  FitProblem(*model.model, test).evaluate(model.fit.parameters, residual, nullptr);
  return static_cast<double>((residual.array().abs() <= model.validation.prediction_bound).count()) /
         static_cast<double>(residual.size());
}

/// The better of two: link torque counts where it is known.
bool better(const ModelScore& a, const ModelScore& b) {
  if (!std::isnan(a.link_rms_Nm)) return a.link_rms_Nm < b.link_rms_Nm;
  return a.r2 > b.r2;
}

std::string line_of(const ModelScore& model) {
  char text[200];
  std::snprintf(text, sizeof text, "%c %-62s %3d %9.5f %10.4f ", model.chosen ? '*' : ' ',
                model.model.c_str(), model.parameters, model.r2, model.rms);
  std::string out = text;
  if (!std::isnan(model.link_rms_Nm)) {
    std::snprintf(text, sizeof text, "%9.2f", model.link_rms_Nm);
    out += text;
  }
  return out + "\n";
}

std::string verdict_of(const RecordingResult& result) {
  const ModelScore& chosen = result.chosen();
  const ModelScore& best = result.best();
  std::string out = "  chosen: " + result.why + ".\n";
  if (best.model != chosen.model)
    out += "  on the scored part " +
           std::string(best.parameters < chosen.parameters ? "a simpler model wins: '"
                                                           : "the best one is '") +
           best.model + "'.\n";
  return out;
}

/// Blocks by turns: 1 in every other block, beginning with `first`.
Eigen::VectorXd every_other(const JointDataset& data, double block_s, long first) {
  return data.time_s.unaryExpr(
      [=](double t) { return (std::lround(std::floor(t / block_s + 1e-9)) + first) % 2 == 0 ? 1.0 : 0.0; });
}

std::vector<FitPiece> encoder_pieces(const Recording& recording, double block_s, long first) {
  std::vector<FitPiece> out = prepare(recording.series, recording.protocol.window,
                                      recording.protocol.prepare);
  for (FitPiece& piece : out) {
    piece.data = encoder_difference(piece.data);
    piece.weight = every_other(piece.data, block_s, first);
  }
  return out;
}

double torsion_rms_Nm(const FootprintTerms& terms, const Recording& recording, double block_s) {
  const FootprintModel model(terms);
  WeightedRms rms;
  for (const long first : {0L, 1L}) {
    const Fit found = fit(FitProblem(model, encoder_pieces(recording, block_s, first)), FitOptions{});
    for (const FitPiece& piece : encoder_pieces(recording, block_s, 1 - first))
      rms.add(model.torque_Nm(piece.data, found.parameters) - piece.data.load_Nm, piece.weight);
  }
  return rms.value();
}

/// Data README: joint 3 of LARA8, from the maker's data sheet.
TorsionSpring lara8_spring() { return TorsionSpring({{0.0, 31e3}, {14.0, 50e3}, {48.0, 57e3}}); }

/// Held-out R2 that is known to be within reach; joints that are not named are only reported.
struct KnownJoint {
  const char* recording;
  double least_r2;
};
constexpr KnownJoint kKnown[] = {
    {"ur10e joint 1", 0.9940}, {"ur10e joint 2", 0.9986}, {"ur10e joint 5", 0.9860}};

constexpr double kMostLinkRms_Nm = 3.6;
constexpr double kLeastCovered = 93.0, kMostCovered = 97.0;  // %
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

const ModelScore& RecordingResult::chosen() const {
  return *std::find_if(models.begin(), models.end(), [](const ModelScore& m) { return m.chosen; });
}

const ModelScore& RecordingResult::best() const {
  return *std::min_element(models.begin(), models.end(), better);
}

RecordingResult result_of(const Recording& recording) {
  const JointResult joint = identify_joint(recording.series, recording.protocol);
  RecordingResult out;
  out.recording = recording.name;
  out.unit = recording.series.torque_unit;
  out.why = joint.why;
  for (std::size_t i = 0; i < joint.models.size(); ++i) {
    const ModelResult& model = joint.models[i];
    out.models.push_back({model.model->name(), model.free_parameters, model.held_out.r2, model.held_out.rms,
                          link_rms_Nm(model, joint.test), i == joint.chosen,
                          model.validation.prediction_bound, covered(model, joint.test)});
  }
  return out;
}

std::string table_of(const std::vector<RecordingResult>& results) {
  std::string out;
  for (const RecordingResult& result : results) {
    char head[200];
    std::snprintf(head, sizeof head, "%s%-64s %3s %9s %8s %s %9s\n", out.empty() ? "" : "\n",
                  result.recording.c_str(), "n", "R2", "rms", result.unit.c_str(),
                  std::isnan(result.models.front().link_rms_Nm) ? "" : "link Nm");
    out += head;
    for (const ModelScore& model : result.models) out += line_of(model);
    out += verdict_of(result);
  }
  return out;
}

FootprintScore footprint_of(const Recording& lara8, double block_s) {
  FootprintTerms with, without;
  with.spring = without.spring = lara8_spring();
  without.motor_harmonics = without.link_harmonics = {};
  return {torsion_rms_Nm(without, lara8, block_s), torsion_rms_Nm(with, lara8, block_s)};
}

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
  add("prediction_bound", result.unit.c_str(), result.chosen().prediction_bound);
  add("prediction_covered", "%", 100.0 * result.chosen().covered, between(kLeastCovered, kMostCovered));
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
