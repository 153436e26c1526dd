#include "tools/lab/leg/foot_return_report.h"

#include <cmath>

#include "tools/lab/leg/release_plots.h"

namespace sprung {
namespace {

using report::hundredths;
using report::Plot;

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

/// Figs. 8 and 9 of S0 are made of these.
std::vector<ReleasedFoot> released(const FootReturnResult& result) {
  std::vector<ReleasedFoot> out;
  for (const FootReturnCaseResult& done : result.cases)
    out.push_back({done.config.name, done.pulls, &done.traces});
  return out;
}

Plot distance_plot(const ReleasedFoot& foot) {
  Plot out = release_distance_plot(foot, "time from the release");
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
  const std::vector<ReleasedFoot> feet = released(result);
  out.plots = {release_error_plot(feet, "pull, eight directions of five forces")};
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (result.cases[i].config.friction_scale != 1.0) continue;
    out.plots.push_back(release_path_plot(feet[i]));
    out.plots.push_back(distance_plot(feet[i]));
  }
  return out;
}

}  // namespace sprung
