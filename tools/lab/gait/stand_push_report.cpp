#include "tools/lab/gait/stand_push_report.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

using report::hundredths;
using report::Plot;
using report::Series;
using report::Style;

report::Table summary_table(const StandPushResult& result) {
  report::Table out{"Peak torque of hip and knee above the static torque",
                    {"push", "signal", "position (Nm)", "compliance (Nm)", "ratio", "foot off, position (mm)",
                     "foot off, compliance (mm)"}};
  for (const PushPair& pair : result.pushes) {
    const PushScore& p = pair.position.score;
    const PushScore& c = pair.compliance.score;
    out.rows.push_back({pair.push.name, "motor side, papers' equation", hundredths(p.excess_motor_Nm),
                        hundredths(c.excess_motor_Nm),
                        hundredths(push_ratio(c.excess_motor_Nm, p.excess_motor_Nm)),
                        hundredths(p.foot_off_mm), hundredths(c.foot_off_mm)});
    out.rows.push_back({pair.push.name, "gear output, true", hundredths(p.excess_output_Nm),
                        hundredths(c.excess_output_Nm),
                        hundredths(push_ratio(c.excess_output_Nm, p.excess_output_Nm)), "", ""});
  }
  const auto pair = [](const Vec3& v) {
    return report::number_text(v[0]) + ", " + report::number_text(v[2]);
  };
  out.note = "Compliance: K " + pair(result.gains.stiffness_N_m) + " N/m, D " +
             pair(result.gains.damping_N_s_m) + " N s/m forward and up at each foot, " +
             report::number_text(result.friction_compensation) +
             " of friction compensated. Position: loops of " +
             report::number_text(result.position_stiffness_Nm_rad) + " Nm/rad, " +
             report::number_text(result.position_damping_Nm_s_rad) + " Nm s/rad at each joint.";
  return out;
}

/// The largest |torque| of all hips and knees.
Series load(const PushRun& run, std::vector<double> PushSample::*torques, const std::string& name, int colour,
            Style style) {
  Series out{name, {}, {}, style, colour};
  for (const PushSample& sample : run.samples) {
    double most = 0.0;
    for (const double torque : sample.*torques) most = std::max(most, std::abs(torque));
    out.x.push_back(sample.time_s);
    out.y.push_back(most);
  }
  return out;
}

Plot load_plot(const PushPair& pair) {
  Plot out{std::string("Torque of the joint that carries most, ") + pair.push.name,
           {"time since the push began", "s"},
           {"torque", "Nm"}};
  out.series = {
      load(pair.position, &PushSample::gear_output_Nm, "position, gear output", 0, Style::kLine),
      load(pair.position, &PushSample::motor_side_Nm, "position, motor side", 0, Style::kDashedLine),
      load(pair.compliance, &PushSample::gear_output_Nm, "compliance, gear output", 1, Style::kLine),
      load(pair.compliance, &PushSample::motor_side_Nm, "compliance, motor side", 1, Style::kDashedLine)};
  out.shades = {{0.0, pair.push.length_s(), "push"}};
  return out;
}

}  // namespace

report::Section stand_push_section(const StandPushResult& result) {
  report::Section out{"Standing, pushed"};
  out.text = {
      "The robot stands free on its feet and is pounded (15 N s within 0.1 s), led down by 10 mm and up by "
      "30 mm (1 s there, 1 s held, 1 s "
      "back), and pressed down with 150 N as slowly, once in position control and once on its virtual "
      "springs (gait stand); and more of the first two. Static "
      "torque: the mean before the push. The papers' joint torque is the motor's; what a pound puts through "
      "the "
      "legs to the floor passes every gear, whatever the control, since rotors and friction hold the "
      "joints. Under the same slow force (pushforce) the gears' outputs carry the same load, by "
      "statics: the slow push that tells one from the other is the one of the same way."};
  out.tables = {summary_table(result)};
  for (const PushPair& pair : result.pushes) out.plots.push_back(load_plot(pair));
  return out;
}

}  // namespace sprung
