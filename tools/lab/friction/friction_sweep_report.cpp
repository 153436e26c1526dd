#include "tools/lab/friction/friction_sweep_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "model/friction/friction_law.h"

namespace sprung {
namespace {

using identification::FitParameter;
using report::Plot;
using report::Series;
using report::Style;
using report::Table;

constexpr int kCurvePoints = 200;
/// A cloud behind a curve, not a wall.
constexpr std::size_t kCloud = 1500;

std::string text(const char* format, double value) {
  char out[64];
  std::snprintf(out, sizeof out, format, value);
  return out;
}

std::set<double> loads_of(const SweepResult& result) {
  std::set<double> out;
  for (const RecordedPass& pass : result.recording.passes) out.insert(pass.pass.load_Nm);
  return out;
}

bool split(const SweepResult& result) {
  return result.fits.front().held_out.samples > 0 && result.points == SweepPoints::kBoth;
}

Table model_table(const SweepResult& result) {
  Table out{"Models", {"model", "parameters", "R² of friction", "RMS (Nm)"}};
  if (split(result)) {
    out.columns.push_back("R², held out");
    out.columns.push_back("RMS, held out (Nm)");
  }
  for (const SweepFit& fit : result.fits) {
    out.rows.push_back(
        {fit.model->name(), fit.model->parameters().size(), text("%.4f", fit.score.r2), fit.score.rms});
    if (!split(result)) continue;
    out.rows.back().push_back(text("%.4f", fit.held_out.r2));
    out.rows.back().push_back(fit.held_out.rms);
  }
  out.note =
      "Parameters include the link's weight where it is not known. R² is of the friction torque: load and "
      "weight are "
      "taken off before the variance is. Presliding is not among them: no pass turns round while samples are "
      "taken.";
  return out;
}

Table protocol_table(const SweepResult& result) {
  Table out{"The same recording, read in other ways (Coulomb + viscous + Stribeck)",
            {"points", "count", "R²", "RMS (Nm)"}};
  using T = identification::JointTerm;
  for (const SweepPoints points :
       {SweepPoints::kForward, SweepPoints::kBoth, SweepPoints::kForwardMeans, SweepPoints::kMagnitudes}) {
    if (points == SweepPoints::kMagnitudes && result.recording.protocol == SweepProtocol::kS1) continue;
    const SweepFit fit = fit_sweep(result.recording, points, {T::kViscous, T::kStribeck});
    out.rows.push_back({name(points), fit.score.samples, text("%.4f", fit.score.r2), fit.score.rms});
  }
  out.note = "One robot, one seed, one law: what is averaged and whether the sign changes decides R².";
  return out;
}

Table parameter_table(const SweepFit& fit) {
  Table out{"Parameters of " + fit.model->name(), {"parameter", "value", "standard error", "unit"}};
  for (const FitParameter& p : fit.model->parameters()) {
    const Estimate e = parameter(fit, p.name);
    out.rows.push_back({p.name, e.value, e.standard_error, p.unit});
  }
  for (const std::string& warning : fit.statistics.warnings) out.note += warning + " ";
  return out;
}

double fastest(const SweepResult& result) {
  double out = 0.0;
  for (const RecordedPass& pass : result.recording.passes) out = std::max(out, pass.pass.speed_rad_s);
  return out;
}

/// The law over speed at one load; a gap where the sign changes.
Series curve(const SweepResult& result, const SweepFit& fit, double load_Nm, const std::string& name,
             int colour) {
  const FrictionParameters law = fit.model->friction(fit.fit.parameters);
  const bool both = result.points == SweepPoints::kBoth;
  const double end = fastest(result);
  Series out{name, {}, {}, Style::kDashedLine, colour};
  for (int i = both ? -kCurvePoints : 1; i <= kCurvePoints; ++i) {
    const double w = end * std::abs(i) / kCurvePoints * i / kCurvePoints;  // denser where it bends
    out.x.push_back(w);
    out.y.push_back(i == 0 ? std::numeric_limits<double>::quiet_NaN()
                           : friction_torque_Nm(law, {w, load_Nm}));
  }
  return out;
}

Series cloud(const SweepFit& fit, bool residual, const std::string& name, int colour) {
  Series out{name, {}, {}, Style::kPoints, colour};
  for (const std::size_t i : evenly_picked(fit.points.size(), kCloud)) {
    const FrictionPoint& p = fit.points[i];
    out.x.push_back(p.velocity_rad_s);
    out.y.push_back(residual ? p.measured_Nm - p.fitted_Nm : p.measured_Nm);
  }
  return out;
}

Series truth(const SweepResult& result) {
  Series out{"plant's truth, mean of a pass", {}, {}, Style::kPoints, 3};
  for (const RecordedPass& pass : result.recording.passes) {
    if (result.points != SweepPoints::kBoth && pass.velocity_rad_s < 0.0) continue;
    out.x.push_back(pass.velocity_rad_s);
    out.y.push_back(std::copysign(pass.true_friction_Nm, pass.velocity_rad_s));
  }
  return out;
}

Plot speed_plot(const SweepResult& result) {
  Plot out{"Friction over speed", {"joint speed", "rad/s"}, {"friction at the joint", "Nm"}};
  out.series.push_back(curve(result, result.fits.front(), 0.0, result.fits.front().model->name(), 1));
  const SweepFit& last = result.fits.back();
  const std::set<double> loads = loads_of(result);
  out.series.push_back(curve(result, last, 0.0, last.model->name(), 2));
  if (loads.size() > 1) {
    out.series.push_back(
        curve(result, last, *loads.rbegin(), "the same, gear gives " + text("%.1f Nm", *loads.rbegin()), 4));
    out.series.push_back(
        curve(result, last, *loads.begin(), "the same, gear gives " + text("%.1f Nm", *loads.begin()), 5));
  }
  out.series.push_back(truth(result));
  out.series.push_back(cloud(last, false, "measured: motor torque minus load", 0));
  out.note = "The truth is drawn for comparison; nothing is fitted to it.";
  return out;
}

Plot residual_plot(const SweepResult& result) {
  Plot out{"Residuals over speed", {"joint speed", "rad/s"}, {"measured minus fitted", "Nm"}};
  out.series.push_back(cloud(result.fits.back(), true, result.fits.back().model->name(), 2));
  out.series.push_back(cloud(result.fits.front(), true, result.fits.front().model->name(), 1));
  return out;
}

Plot load_plot(const SweepResult& result) {
  Plot out{"Residuals over load",
           {"gear output torque", "Nm"},
           {"measured minus fitted, times sign of motion", "Nm"}};
  const SweepFit& without = result.fits[2];
  const SweepFit& with = result.fits.back();
  for (const auto& [fit, colour] : {std::pair{&with, 2}, std::pair{&without, 1}}) {
    Series series{fit->model->name(), {}, {}, Style::kPoints, colour};
    for (const std::size_t i : evenly_picked(fit->points.size(), kCloud)) {
      const FrictionPoint& p = fit->points[i];
      series.x.push_back(p.load_Nm);
      series.y.push_back(std::copysign(1.0, p.velocity_rad_s) * (p.measured_Nm - p.fitted_Nm));
    }
    out.series.push_back(series);
  }
  out.note = "Without the load term what is left rises with the load on both sides.";
  return out;
}

}  // namespace

std::vector<std::string> protocol_text(const SweepResult& result) {
  const std::string joint = result.recording.joint + " of " + result.recording.robot + ", gear " +
                            text("%.0f", result.recording.gear_ratio) + ":1. ";
  const std::string common =
      "Every pass is a joint move through the whole stack at constant speed; the position loop's first "
      "0.25 s are left out; motor torque is R Kt i with robot.yaml's constants, as the drive measures it.";
  switch (result.recording.protocol) {
    case SweepProtocol::kS0:
      return {joint +
                  "S0's protocol (Fig. 5): several constant speeds, there and back over the same angles, "
                  "three times; friction "
                  "is half the difference of the two mean motor torques, so that the weight drops out. S0 "
                  "fits one number to it.",
              common};
    case SweepProtocol::kS1:
      return {joint +
                  "S1's protocol (Fig. 9) as facts papers C4 reads it: no load, 40 speeds uniform in 0.02-4 "
                  "rad/s, 60 single "
                  "samples of each, one direction, no averaging; equation (5) fitted by plain least squares "
                  "together with the "
                  "link's own weight. The scatter is the drive's current noise as sim.yaml has it; nothing "
                  "is added here.",
              common};
    case SweepProtocol::kLoaded:
      return {joint +
                  "Loaded protocol: six speeds from 0.05 to 3 rad/s, both directions, under five constant "
                  "torques from outside up "
                  "to 0.8 of the motor's rated torque, so that the gear drives and is driven back. Every "
                  "second combination of "
                  "load and speed is held out: fitted to the others, scored there.",
              result.recording.passes.front().sensed_torque_Nm.empty()
                  ? "The load is the known outside torque; the link's own weight is fitted."
                  : "The load is what the bench's torque sensor reads, the arm's weight included.",
              common};
  }
  return {};
}

report::Section sweep_section(const SweepResult& result) {
  report::Section out{"Protocol " + std::string(name(result.recording.protocol))};
  out.text = protocol_text(result);
  out.tables = {model_table(result), protocol_table(result), parameter_table(result.fits.back())};
  out.plots = {speed_plot(result), residual_plot(result)};
  if (result.recording.protocol == SweepProtocol::kLoaded) out.plots.push_back(load_plot(result));
  return out;
}

std::string sweep_table(const SweepResult& result) {
  char line[160];
  std::snprintf(line, sizeof line, "%s, %s: %s\n", result.recording.joint.c_str(),
                name(result.recording.protocol), name(result.points));
  std::string out = line;
  for (const SweepFit& fit : result.fits) {
    std::snprintf(line, sizeof line, "  %-36s R2 %.4f  RMS %6.3f Nm", fit.model->name().c_str(), fit.score.r2,
                  fit.score.rms);
    out += line;
    if (split(result)) {
      std::snprintf(line, sizeof line, "  held out R2 %.4f  RMS %6.3f Nm", fit.held_out.r2, fit.held_out.rms);
      out += line;
    }
    out += "\n";
  }
  return out;
}

}  // namespace sprung
