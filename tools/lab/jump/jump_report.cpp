#include "tools/lab/jump/jump_report.h"

#include <cmath>
#include <cstdio>

namespace sprung {
namespace {

using report::Cell;
using report::Mark;
using report::Plot;
using report::Section;
using report::Style;
using report::Table;

constexpr int kHipColour = 1;
constexpr int kKneeColour = 0;
constexpr int kFootColour = 2;

std::string text_of(double value, const char* format) {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return std::isfinite(value) ? text : "-";
}

std::string figure_name(const MeasuredJump& jump) {
  switch (jump.mode) {
    case JumpMode::kPosition:
      return "Position control (S0 Fig. 10)";
    case JumpMode::kTorque:
      return "Torque control (S0 Fig. 11)";
    case JumpMode::kHybrid:
      return "Hybrid control (S0 Fig. 12)";
    case JumpMode::kAdaptive:
      break;
  }
  return "adaptive landing";
}

template <typename Value>
std::vector<double> column(const std::vector<JumpSample>& samples, Value value) {
  std::vector<double> out;
  out.reserve(samples.size());
  for (const JumpSample& sample : samples) out.push_back(value(sample));
  return out;
}

std::vector<double> times(const std::vector<JumpSample>& samples) {
  return column(samples, [](const JumpSample& s) { return s.time_s; });
}

std::vector<report::Shade> shades(const std::vector<JumpSample>& samples) {
  std::vector<report::Shade> out;
  for (const JumpSample& sample : samples) {
    if (out.empty() || out.back().name != name(sample.phase))
      out.push_back({sample.time_s, sample.time_s, name(sample.phase)});
    out.back().to = sample.time_s;
  }
  return out;
}

std::vector<report::Marker> markers(const JumpResult& jump) {
  return {{1e-3 * jump.takeoff_time_ms, "take-off"}, {1e-3 * jump.touchdown_time_ms, "touchdown"}};
}

Plot foot_plot(const MeasuredJump& jump, const std::vector<JumpSample>& samples) {
  Plot out{"Foot below the hip", {"time from the start of the thrust", "s"}, {"y of the foot", "m"}};
  const std::vector<double> t = times(samples);
  out.series = {
      {"desired", t, column(samples, [](const JumpSample& s) { return s.desired_y_m; }), Style::kDashedLine,
       kFootColour},
      {"actual", t, column(samples, [](const JumpSample& s) { return s.y_m; }), Style::kLine, kFootColour},
      {"hip above the floor", t, column(samples, [](const JumpSample& s) { return s.hip_m; }), Style::kLine,
       3}};
  out.shades = shades(samples);
  out.markers = markers(jump.result);
  return out;
}

template <typename MotorSide, typename Output>
Plot torque_plot(const std::string& joint, int colour, const MeasuredJump& jump,
                 const std::vector<JumpSample>& samples, MotorSide motor_side, Output output) {
  Plot out{"Torque of the " + joint, {"time from the start of the thrust", "s"}, {"torque", "Nm"}};
  const std::vector<double> t = times(samples);
  out.series = {{"papers' equation (6): motor side", t, column(samples, motor_side), Style::kLine, colour},
                {"gear output, what the link truly feels", t, column(samples, output), Style::kLine, 4}};
  out.shades = shades(samples);
  out.markers = markers(jump.result);
  return out;
}

Section figure_section(const MeasuredJump& jump, const std::vector<JumpSample>& samples) {
  Section out{figure_name(jump) + ", preset " + jump.preset};
  const JumpResult& r = jump.result;
  out.text = {"The hip rises " + text_of(r.height_mm, "%.0f mm") + " and the foot is back on the floor " +
              text_of(r.touchdown_time_ms, "%.0f ms") +
              " after the thrust began. In the push-off the motors' side of the knee shows " +
              text_of(r.peak_knee_torque_Nm, "%.0f Nm") + " where the link feels " +
              text_of(r.peak_knee_output_torque_Nm, "%.0f Nm") +
              ": the rest turns the rotor. In the landing it is " +
              text_of(r.landing_knee_torque_Nm, "%.1f Nm") + " by the papers' signal and " +
              text_of(r.landing_knee_output_torque_Nm, "%.1f Nm") + " in truth."};
  out.plots = {
      foot_plot(jump, samples),
      torque_plot(
          "knee", kKneeColour, jump, samples, [](const JumpSample& s) { return s.knee_motor_side_Nm; },
          [](const JumpSample& s) { return s.knee_output_Nm; }),
      torque_plot(
          "hip", kHipColour, jump, samples, [](const JumpSample& s) { return s.hip_motor_side_Nm; },
          [](const JumpSample& s) { return s.hip_output_Nm; })};
  return out;
}

Cell verdict(const ReportRow& row) {
  if (!row.low && !row.high) return Cell("");
  return row.ok() ? Cell("as demanded", Mark::kGood) : Cell("not as demanded", Mark::kBad);
}

Table rows_table(const std::vector<ReportRow>& rows) {
  Table table{"Every figure", {"figure", "unit", "paper", "ours", "ours / paper", "demand"}};
  for (const ReportRow& row : rows) {
    const double ratio = row.paper ? row.value / *row.paper : kNaN;
    const bool of_the_18 = row.paper && row.name.find(".ratio.") == std::string::npos &&
                           row.name.find(".paper.") == std::string::npos;
    const Mark mark = !of_the_18 ? Mark::kPlain : std::abs(ratio - 1.0) <= 0.1 ? Mark::kGood : Mark::kBad;
    table.rows.push_back({row.name, row.unit, row.paper ? Cell(*row.paper) : Cell(""), row.value,
                          row.paper ? Cell(ratio, mark) : Cell(""), verdict(row)});
  }
  table.note =
      "Heights count from where the hip is when the foot leaves the floor (errata E11). Peaks of the jump "
      "are those of the "
      "push-off; time to peak counts from the first set-point of the thrust. *_output_* is the truth at the "
      "gear's output.";
  return table;
}

Section summary_section(const JumpExperiment& experiment) {
  Section out{"Summary"};
  const PaperScore score = score_against_paper(experiment.jumps);
  out.text = {
      "The leg jumps once in each way of control on the same simulated plant: the drives hold positions, the "
      "legs are virtual "
      "springs throughout, or positions until shortly before touchdown and a soft spring from there "
      "(hybrid). The last case is "
      "adaptive landing.",
      "Two torques are drawn. The papers' signal is the gear ratio times motor torque, less friction. The "
      "gear's output is what "
      "the link feels; between them stands the rotor's inertia, which in a jump takes most of the motor "
      "(errata E6, E8)."};
  if (score.figures > 0) {
    std::string misses;
    for (const std::string& miss : score.misses) misses += (misses.empty() ? "" : ", ") + miss;
    out.text.push_back(std::to_string(score.within) + " of the paper's " + std::to_string(score.figures) +
                       " figures are met within 10 %." +
                       (misses.empty() ? "" : " Not: " + misses + "; docs/control.md says why."));
  }
  out.tables = {rows_table(experiment.rows)};
  return out;
}

void add_gains(const std::string& what, const StiffnessConfig& gains, Table& table) {
  table.rows.push_back({what + ": stiffness x, z (N/m)",
                        text_of(gains.stiffness_N_m[0], "%.5g, ") + text_of(gains.stiffness_N_m[2], "%.5g")});
  table.rows.push_back({what + ": damping x, z (N s/m)",
                        text_of(gains.damping_N_s_m[0], "%.5g, ") + text_of(gains.damping_N_s_m[2], "%.5g")});
  table.rows.push_back({what + ": share of the desired velocity", gains.velocity_feedforward});
}

Table preset_table(const PresetConfig& preset) {
  Table table{"Preset " + preset.name, {"parameter", "value"}};
  table.folded = true;
  std::string lengths;
  for (const double length_m : preset.jump_curve.lengths_m) lengths += text_of(length_m, "%.4g ");
  table.rows.push_back({"jump curve, control points of the leg's length (m)", lengths});
  table.rows.push_back({"jump curve, duration (s)", preset.jump_curve.duration_s});
  table.rows.push_back({"landing length (m)", preset.landing_length_m});
  table.rows.push_back({"hybrid: soft from (s)", preset.hybrid_switch_s});
  table.rows.push_back({"friction compensated (share)", preset.friction_compensation});
  add_gains("torque jump", preset.torque_jump, table);
  add_gains("hybrid landing", preset.hybrid_landing, table);
  return table;
}

Section parameter_section(const RobotConfig& robot, const SimOptions& sim, const JumpExperiment& experiment) {
  Section out{"Parameters"};
  out.tables.push_back(preset_table(robot.preset(experiment.preset)));
  const std::string best = preset_or(robot, "best", experiment.preset);
  if (experiment.preset != best) out.tables.push_back(preset_table(robot.preset(best)));
  Table plant{"Plant", {"change", "value"}};
  plant.note = "The plant is robots/" + robot.name + "/sim.yaml, with these changes.";
  for (const auto& [key, value] : sim.plant) plant.rows.push_back({key, value});
  out.tables.push_back(plant);
  return out;
}

}  // namespace

Section jump_figure(const MeasuredJump& jump, const std::vector<JumpSample>& samples) {
  return figure_section(jump, samples);
}

std::vector<Section> jump_sections(const RobotConfig& robot, const SimOptions& sim,
                                   const JumpExperiment& experiment) {
  std::vector<Section> out = {summary_section(experiment)};
  for (std::size_t i = 0; i < experiment.jumps.size(); ++i) {
    const MeasuredJump& jump = experiment.jumps[i];
    const bool for_comparison = jump.preset != experiment.preset && jump.mode != JumpMode::kAdaptive;
    if (!for_comparison) out.push_back(figure_section(jump, experiment.samples[i]));
  }
  out.push_back(parameter_section(robot, sim, experiment));
  return out;
}

}  // namespace sprung
