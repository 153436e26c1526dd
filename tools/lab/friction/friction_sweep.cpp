#include "tools/lab/friction/friction_sweep.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "tools/lab/friction/friction_sweep_report.h"

namespace sprung {
namespace {

using identification::JointTerm;
using identification::JointTerms;

constexpr double kS0Ratio = 100.0;      // facts papers A1
constexpr double kS0Coulomb_Nm = 1.79;  // the same
constexpr double kS1Ratio = 50.0;       // facts papers A3
constexpr double kS1R2 = 0.9319;        // the same
constexpr double kS1R2Within = 0.02;    // demanded: facts goal 4
constexpr double kLoadedR2 = 0.98;      // the same

SweepPoints points_of(SweepProtocol protocol) {
  switch (protocol) {
    case SweepProtocol::kS0:
      return SweepPoints::kMagnitudes;
    case SweepProtocol::kS1:
      return SweepPoints::kForward;
    case SweepProtocol::kLoaded:
      return SweepPoints::kBoth;
  }
  return SweepPoints::kBoth;
}

const SweepFit* find(const std::vector<SweepFit>& fits, const JointTerms& terms) {
  for (const SweepFit& fit : fits) {
    if (fit.model->name() == identification::name(terms)) return &fit;
  }
  return nullptr;
}

void add_parameters(const SweepFit& fit, const std::string& prefix, std::vector<ReportRow>& rows) {
  for (const identification::FitParameter& p : fit.model->parameters()) {
    if (p.name.find("gravity") == 0) continue;
    const Estimate estimate = parameter(fit, p.name);
    rows.push_back(row(prefix + p.name, p.unit, estimate.value));
    rows.push_back(row(prefix + p.name + "_standard_error", p.unit, estimate.standard_error));
  }
}

/// S0's one number and whether "velocity has little effect".
std::vector<ReportRow> s0_rows(const SweepResult& result, const std::string& prefix) {
  const SweepFit& coulomb = result.fits.front();
  std::vector<ReportRow> rows = {
      row(prefix + "coulomb", "Nm", parameter(coulomb, "coulomb").value,
          demanded(result.recording.gear_ratio == kS0Ratio, {{}, {}, kS0Coulomb_Nm}))};
  const auto [least, most] = std::minmax_element(
      coulomb.points.begin(), coulomb.points.end(),
      [](const auto& a, const auto& b) { return a.measured_Nm < b.measured_Nm; });
  rows.push_back(row(prefix + "slowest_to_fastest", "", most->measured_Nm / least->measured_Nm));
  return rows;
}

std::vector<ReportRow> s1_rows(const SweepResult& result, const std::string& prefix) {
  const JointTerms stribeck = {JointTerm::kViscous, JointTerm::kStribeck};
  const SweepFit& fit = *find(result.fits, stribeck);
  std::vector<ReportRow> rows = {row(
      prefix + "r2", "", fit.score.r2,
      demanded(result.recording.gear_ratio == kS1Ratio, {0.93 - kS1R2Within, 0.93 + kS1R2Within, kS1R2}))};
  for (const auto& [points, quantity] : {std::pair{SweepPoints::kBoth, "both_directions_r2"},
                                         std::pair{SweepPoints::kForwardMeans, "averaged_r2"}})
    rows.push_back(row(prefix + quantity, "", fit_sweep(result.recording, points, stribeck).score.r2));
  rows.push_back(row(prefix + "rms", "Nm", fit.score.rms));
  add_parameters(fit, prefix, rows);
  return rows;
}

std::vector<ReportRow> loaded_rows(const SweepResult& result, const std::string& prefix) {
  const SweepFit& with_load = result.fits.back();
  const SweepFit& without = *find(result.fits, {JointTerm::kViscous, JointTerm::kStribeck});
  std::vector<ReportRow> rows = {row(prefix + "r2", "", with_load.held_out.r2, at_least(kLoadedR2))};
  rows.push_back(row(prefix + "without_load_term_r2", "", without.held_out.r2));
  rows.push_back(row(prefix + "rms", "Nm", with_load.held_out.rms));
  rows.push_back(row(prefix + "without_load_term_rms", "Nm", without.held_out.rms));
  add_parameters(with_load, prefix, rows);
  return rows;
}

}  // namespace

SweepResult run_friction_sweep(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                               int joint, SweepProtocol protocol) {
  SweepResult out;
  out.recording = record_sweep(robot, preset, sim, joint, protocol,
                               sweep_plan(protocol, bench_limits(robot, joint)));
  out.points = points_of(protocol);
  for (const JointTerms& terms : sweep_models(out.recording, out.points))
    out.fits.push_back(fit_sweep(out.recording, out.points, terms));
  return out;
}

std::vector<ReportRow> sweep_rows(const SweepResult& result, const std::string& prefix) {
  switch (result.recording.protocol) {
    case SweepProtocol::kS0:
      return s0_rows(result, prefix + ".");
    case SweepProtocol::kS1:
      return s1_rows(result, prefix + ".");
    case SweepProtocol::kLoaded:
      return loaded_rows(result, prefix + ".");
  }
  return {};
}

std::vector<ReportRow> friction_fit_rows(const RobotConfig& robot, const std::string& preset,
                                         const SimOptions& sim, double* simulated_s) {
  std::vector<ReportRow> out;
  for (const auto& [protocol, prefix] :
       {std::pair{SweepProtocol::kS1, "estimator.friction_fit"},
        std::pair{SweepProtocol::kLoaded, "estimator.friction_fit_loaded"}}) {
    const SweepResult result = run_friction_sweep(robot, preset, sim, bench_joint(robot, ""), protocol);
    if (simulated_s != nullptr) *simulated_s += result.recording.simulated_s;
    for (const ReportRow& row : sweep_rows(result, prefix)) {
      if (row.low || row.high) out.push_back(row);
    }
  }
  return out;
}

namespace {

void add_sweep(const SweepResult& result, ExperimentOutput& out) {
  for (const ReportRow& row :
       sweep_rows(result, std::string("friction_sweep.") + name(result.recording.protocol)))
    out.rows.push_back(row);
  out.simulated_s += result.recording.simulated_s;
  out.sections.push_back(sweep_section(result));
  out.before += sweep_table(result);
}

}  // namespace

Experiment friction_sweep_experiment() {
  struct Own {
    std::string joint, protocol = "all";
  };
  const auto own = std::make_shared<Own>();
  Experiment out;
  out.name = "friction_sweep";
  out.what =
      "Constant speeds on one joint by the papers' protocols and with loads: every friction model beside the "
      "others.";
  out.question = "Which model says most of a gear's friction over speed and load, and with which parameters?";
  out.robot = "test_axis";
  out.robot_help = "test_axis, pegasus, or a folder";
  out.takes = {Common::kPlant, Common::kReport};
  out.in_all = {RobotKind::kJoint};
  out.example = "--robot pegasus --protocol s1 --report sweep.html";
  out.own.option("--joint", own->joint, "by name; default: the bench's arm, or the first knee");
  out.own.choice("--protocol", own->protocol, {"all", "s0", "s1", "loaded"}, "which sweep");
  out.run = [own](const ExperimentInput& in) {
    const int joint = bench_joint(in.robot, own->joint);
    ExperimentOutput output;
    for (const SweepProtocol protocol : {SweepProtocol::kS0, SweepProtocol::kS1, SweepProtocol::kLoaded}) {
      if (own->protocol == "all" || own->protocol == name(protocol))
        add_sweep(run_friction_sweep(in.robot, in.preset, in.sim, joint, protocol), output);
    }
    return output;
  };
  return out;
}

}  // namespace sprung
