#include "tools/lab/leg/hanging_return.h"
#include "tools/lab/leg/release_plots.h"

namespace sprung {
namespace {

using report::hundredths;

report::Table summary_table(const HangingReturnResult& result) {
  report::Table out{"Where the foot stops after the hand has let go",
                    {"case", "preset", "K forward, up (N/m)", "D forward, up (N s/m)", "compensated",
                     "plant's friction, masses, torque constants", "mean (mm)", "max (mm)", "min (mm)",
                     "settled (s)", "limit cycles"}};
  for (const HangingCaseResult& done : result.cases) {
    const FootReturnSummary& s = done.summary;
    const StiffnessConfig& gains = done.config.gains;
    const auto pair = [](const Vec3& v) {
      return report::number_text(v[0]) + ", " + report::number_text(v[2]);
    };
    out.rows.push_back({done.config.name, done.config.preset, pair(gains.stiffness_N_m),
                        pair(gains.damping_N_s_m), done.config.friction_compensation,
                        plant_text(done.config.plant), hundredths(s.mean_mm), hundredths(s.max_mm),
                        hundredths(s.min_mm), hundredths(s.settled_worst_s), s.limit_cycles});
  }
  out.note =
      "S1, Fig. 10: mean 8.91, max 12.4, min 5.2 mm without, 3.88, 7.1, 1.8 mm with its compensation. Its "
      "errors imply 3.2 Nm of stick "
      "friction, where this plant has 4.3: `without` and `paper` are on a plant of that friction, "
      "`without_as_is` has plant and springs of `with`.";
  return out;
}

std::vector<ReleasedFoot> released(const HangingReturnResult& result) {
  std::vector<ReleasedFoot> out;
  for (const HangingCaseResult& done : result.cases) {
    out.push_back({done.config.name, {}, &done.traces});
    for (const HangingPull& pull : done.pulls) out.back().pulls.push_back(pull.result);
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
      "the foot's distance from home as the robot knows it (lengths and zeros that robot.yaml does not know "
      "put "
      "it elsewhere), in the leg's plane, is the error. Settled: from then on within 0.5 mm of where it "
      "stops. A limit "
      "cycle is a foot that "
      "moves by more than 0.2 mm, or a commanded torque that changes by more than 1 Nm, later than 1.5 s "
      "after the hand has gone."};
  out.tables = {summary_table(result)};
  const std::vector<ReleasedFoot> feet = released(result);
  out.plots = {release_error_plot(feet, "pull, eight directions of five ways")};
  for (const ReleasedFoot& foot : feet) {
    out.plots.push_back(release_path_plot(foot));
    out.plots.push_back(release_distance_plot(foot, "time from when the hand has let go"));
  }
  return out;
}

}  // namespace sprung
