#include "tests/tools/common/report/report_sample.h"

#include <cmath>

namespace sprung::report {

namespace {

using Column = std::vector<double>;

constexpr double kReportSampleNan = std::numeric_limits<double>::quiet_NaN();

template <typename Function>
Column values(const Column& x, Function function) {
  Column y;
  for (const double value : x) y.push_back(function(value));
  return y;
}

Column evenly(double from, double to, std::size_t count) {
  Column x;
  for (std::size_t i = 0; i < count; ++i) {
    x.push_back(from + (to - from) * static_cast<double>(i) / static_cast<double>(count - 1));
  }
  return x;
}

/// -1 ... 1, without pattern and the same each time.
double noise(double seed) {
  return 2.0 * std::fmod(std::fabs(std::sin(seed * 12.9898) * 43758.5453), 1.0) - 1.0;
}

double torque_Nm(double time_s) {
  if (time_s < 0.9) return 8.0 + 3.0 * std::sin(4.0 * time_s);
  if (time_s < 1.2) return 11.0 + 60.0 * std::sin((time_s - 0.9) / 0.3 * M_PI);
  if (time_s < 1.6) return 0.5 * std::sin(40.0 * time_s);
  return 45.0 * std::exp(-(time_s - 1.6) * 4.0) * std::cos(25.0 * (time_s - 1.6)) + 9.0;
}

Plot torque_plot(std::size_t samples) {
  const Column time = evenly(0.0, 3.0, samples);
  const Column estimate = values(time, [](double t) { return torque_Nm(t) + 1.5 * noise(t); });
  const auto shifted = [&estimate](double by) {
    return values(estimate, [by](double torque) { return torque + by; });
  };
  const auto sensor = [](double t) { return t > 2.2 && t < 2.3 ? kReportSampleNan : torque_Nm(t); };
  Plot plot{"Knee torque in a jump", {"time", "s"}, {"gear output torque", "Nm"}, {}};
  plot.series = {{"measured", time, values(time, sensor), Style::kLine, 0},
                 {"estimated", time, estimate, Style::kLine, 1},
                 {"commanded", time, values(time, [](double t) { return t < 1.2 ? torque_Nm(t) : 0.0; }),
                  Style::kDashedLine, 2}};
  plot.bands = {{"95 % bound", time, shifted(-6.0), shifted(6.0), 1}};
  plot.shades = {{0, 0.5, "stand"},    {0.5, 0.9, "crouch"},  {0.9, 1.2, "thrust"},
                 {1.2, 1.6, "flight"}, {1.6, 2.3, "landing"}, {2.3, HUGE_VAL, "stand"}};
  plot.markers = {{1.2, "lift-off"}, {1.6, "touchdown"}, {1.603, "contact reported"}};
  plot.note = "The sensor is not read from 2.2 to 2.3 s.";
  return plot;
}

Plot height_plot() {
  const Column time = evenly(0.0, 3.0, 301);
  const auto height = [](double t) {
    return t < 1.2 || t > 1.6 ? 300.0 : 300.0 + 4900.0 * (t - 1.2) * (1.6 - t);
  };
  return {"Height of the body", {"time", "s"}, {"height", "mm"}, {{"body", time, values(time, height)}}};
}

Plot friction_plot() {
  const Column index = evenly(0.0, 60000.0, 60001);
  const auto friction = [](double v) {
    const double size = 5.0 + 3.0 * std::exp(-std::fabs(v) / 0.2) + 1.4 * std::fabs(v);
    return v > 0.0 ? size : -size;
  };
  const Column speed = values(index, [](double i) { return 2.5 * noise(i + 0.5); });
  Column torque;
  for (std::size_t i = 0; i < speed.size(); ++i) torque.push_back(friction(speed[i]) + noise(index[i] * 3.7));
  const Column fit = evenly(-2.5, 2.5, 400);
  return {"Friction over speed",
          {"speed", "rad/s"},
          {"friction", "Nm"},
          {{"samples", speed, torque, Style::kPoints, 0},
           {"Stribeck", fit, values(fit, friction), Style::kLine, 1}}};
}

Plot path_plot() {
  const Column angle = evenly(0.0, 2.0 * M_PI, 200);
  Plot plot{"Path of the foot", {"x", "mm"}, {"y", "mm"}, {}};
  for (const double radius : {30.0, 60.0}) {
    plot.series.push_back({"pull of " + number_text(radius) + " mm",
                           values(angle, [radius](double a) { return radius * std::cos(a); }),
                           values(angle, [radius](double a) { return radius * std::sin(a) - 400.0; })});
  }
  plot.equal_axes = true;
  return plot;
}

Plot many_series_plot() {
  const Column time = evenly(0.0, 10.0, 500);
  Plot plot{"Twelve joints", {"time", "s"}, {"", ""}, {}};
  plot.y = {"temperature", "\u00b0C"};
  for (int joint = 0; joint < 12; ++joint) {
    plot.series.push_back({"joint " + std::to_string(joint + 1), time,
                           values(time, [joint](double t) { return 24.0 + joint + t * 0.2 * joint; })});
  }
  return plot;
}

Plot residual_plot() {
  const Column speed = evenly(0.0, 30.0, 31);
  return {"Residual, few points",
          {"load", "Nm"},
          {"residual", "Nm"},
          {{"held out", speed, values(speed, [](double v) { return noise(v); }), Style::kPoints}}};
}

Section summary() {
  Section section{"Summary"};
  section.text = {
      "The estimate follows the sensor to 1.5 Nm RMS; friction & inertia are taken off. Made-up curves."};
  section.tables = {{"Against what is asked for",
                     {"quantity", "reach", "here", "ratio"},
                     {{"RMS error in the push-off (Nm)", "<= 4", {3.21234567, Mark::kGood}, 0.80309},
                      {"RMS error at landing (Nm)", "<= 3.5", {4.1, Mark::kBad}, 1.1714},
                      {"contact delay (ms)", "<= 5", "-", ""}},
                     "Sensor: 300 Hz."}};
  return section;
}

Section parameters() {
  Table table{"Parameters", {"name", "value", "unit", "source"}, {}};
  table.folded = true;
  for (int i = 0; i < 8; ++i) table.rows.push_back({"coulomb_" + std::to_string(i), 5.5 + i, "Nm", "fit"});
  return {"Parameters", {}, {table}, {}};
}

}  // namespace

Report sample_report(std::size_t samples) {
  Report report{"Sample <report> & \"all\" of it", "single_leg, preset best, seed 7"};
  report.command = "sprung experiment jump --robot single_leg --seed 7 --report 'a.html'";
  report.sections = {
      summary(),
      {"Jump", {"The same stretch of time in both plots."}, {}, {torque_plot(samples), height_plot()}},
      {"Friction", {}, {}, {friction_plot(), residual_plot()}},
      {"Foot & joints", {}, {}, {path_plot(), many_series_plot()}},
      parameters()};
  return report;
}

}  // namespace sprung::report
