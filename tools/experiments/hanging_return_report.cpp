#include "tools/experiments/hanging_return_report.h"

#include <cmath>

namespace sprung {
namespace {

using report::Plot;
using report::Series;
using report::Style;

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

double hundredths(double value) { return 0.01 * std::round(100.0 * value); }

std::string direction_name(const HangingPull& pull) {
  return report::number_text(std::round(pull.hand.direction_rad * kDegrees)) + " degrees";
}

report::Table summary_table(const HangingReturnResult& result) {
  report::Table out{"Where the foot stops after the hand has let go",
                    {"case", "preset", "K forward, up (N/m)", "D forward, up (N s/m)", "compensated",
                     "plant's friction", "mean (mm)", "max (mm)", "min (mm)", "settled (s)", "limit cycles"}};
  for (const HangingCaseResult& done : result.cases) {
    const FootReturnSummary& s = done.summary;
    const StiffnessConfig& gains = done.config.gains;
    const auto pair = [](const Vec3& v) {
      return report::number_text(v[0]) + ", " + report::number_text(v[2]);
    };
    out.rows.push_back({done.config.name, done.config.preset, pair(gains.stiffness_N_m),
                        pair(gains.damping_N_s_m), done.config.friction_compensation,
                        hundredths(done.config.friction_scale), hundredths(s.mean_mm), hundredths(s.max_mm),
                        hundredths(s.min_mm), hundredths(s.settled_worst_s), s.limit_cycles});
  }
  out.note =
      "S1, Fig. 10: mean 8.91, max 12.4, min 5.2 mm without, 3.88, 7.1, 1.8 mm with its compensation. Its "
      "errors imply 3.2 Nm of stick "
      "friction, where this plant has 4.3: `without` and `paper` are on a plant of that friction, "
      "`without_as_is` is not.";
  return out;
}

Plot error_plot(const HangingReturnResult& result) {
  Plot out{"Foot return error of every pull", {"pull, eight directions of five ways", ""}, {"error", "mm"}};
  int colour = 0;
  for (const HangingCaseResult& done : result.cases) {
    Series series{done.config.name, {}, {}, Style::kPoints, colour++};
    for (std::size_t i = 0; i < done.pulls.size(); ++i) {
      series.x.push_back(static_cast<double>(i + 1));
      series.y.push_back(done.pulls[i].result.error_mm);
    }
    out.series.push_back(series);
  }
  return out;
}

/// The longest pull of each direction.
Plot path_plot(const HangingCaseResult& done) {
  Plot out{"Path of the foot, " + done.config.name, {"forward", "mm"}, {"up", "mm"}};
  out.equal_axes = true;
  for (std::size_t i = 4; i < done.traces.size(); i += 5) {
    Series series{direction_name(done.pulls[i]), {}, {}};
    for (const PlanePoint& foot : done.traces[i].foot_m) {
      series.x.push_back(1e3 * foot.x_m);
      series.y.push_back(1e3 * foot.z_m);
    }
    out.series.push_back(series);
  }
  return out;
}

Plot distance_plot(const HangingCaseResult& done) {
  Plot out{"Distance from home, " + done.config.name,
           {"time from when the hand has let go", "s"},
           {"distance", "mm"}};
  for (std::size_t i = 4; i < done.traces.size(); i += 5) {
    Series series{direction_name(done.pulls[i]), done.traces[i].time_s, {}};
    for (const PlanePoint& foot : done.traces[i].foot_m)
      series.y.push_back(1e3 * std::hypot(foot.x_m, foot.z_m));
    out.series.push_back(series);
  }
  return out;
}

}  // namespace

report::Section hanging_return_section(const HangingReturnResult& result) {
  report::Section out{"Foot return"};
  out.text = {
      "The trunk hangs, every foot on a virtual spring (comply). A hand leads the left hind foot away by 8 "
      "to 40 mm within 1 s, holds it "
      "for 0.5 s, and lets go: its force fades in a straight line within 1 to 3 s. 2.5 s after it is gone "
      "the foot's distance from home, "
      "in the leg's plane, is the error. Settled: from then on within 0.5 mm of where it stops. A limit "
      "cycle is a foot that "
      "moves by more than 0.2 mm, or a commanded torque that changes by more than 1 Nm, later than 1.5 s "
      "after the hand has gone."};
  out.tables = {summary_table(result)};
  out.plots = {error_plot(result)};
  for (const HangingCaseResult& done : result.cases) {
    out.plots.push_back(path_plot(done));
    out.plots.push_back(distance_plot(done));
  }
  return out;
}

}  // namespace sprung
