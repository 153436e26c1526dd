#include "tools/experiments/foot_return_report.h"

#include <cmath>

namespace sprung {
namespace {

using report::Plot;
using report::Series;
using report::Style;

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// For a table: the foot's true place is known to far more digits than anyone needs.
double hundredths(double value) { return 0.01 * std::round(100.0 * value); }

report::Table summary_table(const FootReturnResult& result) {
  report::Table out{"Where the foot stops after a release",
                    {"case", "K (N/m)", "compensated", "plant's friction", "mean (mm)", "max (mm)",
                     "min (mm)", "moved at least (mm)", "settled (s)", "limit cycles", "measured K (N/m)"}};
  for (const FootReturnCaseResult& done : result.cases) {
    const FootReturnSummary& s = done.summary;
    const FootReturnScript& script = done.config.script;
    out.rows.push_back({done.config.name, script.stiffness_N_m, script.friction_compensation,
                        done.config.friction_scale, hundredths(s.mean_mm), hundredths(s.max_mm),
                        hundredths(s.min_mm), hundredths(s.moved_least_mm), hundredths(s.settled_worst_s),
                        s.limit_cycles,
                        report::number_text(std::round(s.stiffness_least_N_m)) + " to " +
                            report::number_text(std::round(s.stiffness_most_N_m))});
  }
  out.note =
      "S0: under 1 mm with compensation, 23 to 46 mm without. The measured K is the slope of force over way "
      "between the "
      "five forces of a direction.";
  return out;
}

/// Figs. 8 and 9 of S0: error of every pull.
Plot error_plot(const FootReturnResult& result) {
  Plot out{"Foot return error of every pull", {"pull, eight directions of five forces", ""}, {"error", "mm"}};
  int colour = 0;
  for (const FootReturnCaseResult& done : result.cases) {
    Series series{done.config.name, {}, {}, Style::kPoints, colour++};
    for (std::size_t i = 0; i < done.pulls.size(); ++i) {
      series.x.push_back(static_cast<double>(i + 1));
      series.y.push_back(done.pulls[i].error_mm);
    }
    out.series.push_back(series);
  }
  return out;
}

/// The strongest pull of each direction, in the leg's plane.
Plot path_plot(const FootReturnCaseResult& done) {
  Plot out{"Path of the foot, " + done.config.name, {"forward", "mm"}, {"up", "mm"}};
  out.equal_axes = true;
  for (std::size_t i = 4; i < done.traces.size(); i += 5) {
    const PullTrace& trace = done.traces[i];
    Series series{
        report::number_text(std::round(done.pulls[i].pull.direction_rad * kDegrees)) + " degrees", {}, {}};
    for (const PlanePoint& foot : trace.foot_m) {
      series.x.push_back(1e3 * foot.x_m);
      series.y.push_back(1e3 * foot.z_m);
    }
    out.series.push_back(series);
  }
  return out;
}

Plot distance_plot(const FootReturnCaseResult& done) {
  Plot out{"Distance from home, " + done.config.name, {"time from the release", "s"}, {"distance", "mm"}};
  for (std::size_t i = 4; i < done.traces.size(); i += 5) {
    Series series{report::number_text(std::round(done.pulls[i].pull.direction_rad * kDegrees)) + " degrees",
                  done.traces[i].time_s,
                  {}};
    for (const PlanePoint& foot : done.traces[i].foot_m)
      series.y.push_back(1e3 * std::hypot(foot.x_m, foot.z_m));
    out.series.push_back(series);
  }
  out.shades = {{-foot_return::kGrow_s - foot_return::kHold_s, -foot_return::kHold_s, "force grows"},
                {-foot_return::kHold_s, 0.0, "held"}};
  return out;
}

}  // namespace

report::Section foot_return_section(const FootReturnResult& result) {
  report::Section out{"Foot return"};
  out.text = {
      "The leg hangs, its foot on a virtual spring. Five pulls to a run: before each the position loops have "
      "brought the foot home (the operator's stand and stop); in compliance (comply) an "
      "outside force at the foot grows over 0.7 s, is held for 0.3 s and is gone at once. 2.5 s later the "
      "foot's distance from "
      "home is the error. A limit cycle is a foot that moves by more than 0.2 mm, or a commanded torque that "
      "changes by more than "
      "1 Nm, later than 1.5 s after the release."};
  out.tables = {summary_table(result)};
  out.plots = {error_plot(result)};
  for (const FootReturnCaseResult& done : result.cases) {
    if (done.config.friction_scale != 1.0) continue;
    out.plots.push_back(path_plot(done));
    out.plots.push_back(distance_plot(done));
  }
  return out;
}

}  // namespace sprung
