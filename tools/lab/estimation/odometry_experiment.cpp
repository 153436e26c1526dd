#include "tools/lab/estimation/odometry_experiment.h"

#include <memory>

#include "signals/angles.h"
#include "tools/lab/estimation/odometry_score.h"
#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

constexpr double kLeastEight_m = 2.0, kMostEight_m = 1000.0;
constexpr double kDegrees_per_rad = 180.0 / kPi;
constexpr double kSpeedShare = 0.7,
                 kTurningShare = 0.25;  // of the gait's fastest, together within its voltage

struct OdometryOptions {
  std::string gait;  ///< empty: all that go forward
  double distance_m = 10.0;
};

struct EightRun {
  OdometryScore score;
  int slips = 0;
  bool upright = false;
  double simulated_s = 0.0;
};

EightRun walk_eight(const ExperimentInput& in, const GaitConfig& gait, double distance_m) {
  EightRun out;
  WalkingRobot walker(in.robot, in.preset, lying(in.sim));
  BodyState estimated;
  const auto watch = [&](InProcessRobot& robot) {
    if (robot.body_state(estimated)) out.score.add(estimated, robot.truth());
  };
  const double speed_m_s = kSpeedShare * gait.fastest_forward_m_s;
  for (const double side : {1.0, -1.0}) {
    walker.walk(gait.name, {speed_m_s, 0.0, side * kTurningShare * gait.fastest_turning_rad_s});
    const double lasts_s = 0.5 * distance_m / speed_m_s;
    for (double time_s = 0.0; time_s < lasts_s && walker.upright(); time_s += 0.5) walker.run(0.5, watch);
  }
  out.slips = estimated.slips;
  out.upright = walker.upright();
  out.simulated_s = walker.simulated_s();
  return out;
}

/// The covariance stands for robots as they are built: sim.yaml's has none of their errors.
Bounds nees_bounds(const ExperimentInput& in) {
  return in.sim.plant.count("draw") != 0 ? between(0.22, 9.35) : at_most(9.35);
}

void add_rows(const ExperimentInput& in, const GaitConfig& gait, const EightRun& run,
              std::vector<ReportRow>& rows) {
  const std::string name = "odometry." + gait.name;
  const OdometryScore& score = run.score;
  const bool went = run.upright && score.begun();
  const auto of = [went](double value) { return went ? value : kNaN; };
  rows.push_back(row(name + ".way", "m", of(score.way_m())));
  rows.push_back(
      row(name + ".position_error", "%", of(100.0 * score.position_error_m() / score.way_m()), at_most(3.0)));
  rows.push_back(
      row(name + ".heading_error", "deg", of(kDegrees_per_rad * std::abs(score.heading_error_rad()))));
  rows.push_back(row(name + ".tilt_worst", "deg", of(kDegrees_per_rad * score.worst_tilt_rad())));
  rows.push_back(row(name + ".tilt_when_turned", "deg",
                     of(kDegrees_per_rad * score.worst_tilt_when_turned_rad()),
                     demanded(std::isfinite(score.worst_tilt_when_turned_rad()), at_most(1.0))));
  rows.push_back(row(name + ".velocity_rms", "mm/s", of(1e3 * score.velocity_rms_m_s())));
  rows.push_back(row(name + ".velocity_worst", "mm/s", of(1e3 * score.worst_velocity_m_s()), at_most(50.0)));
  rows.push_back(row(name + ".position_nees", "", of(score.position_nees()), nees_bounds(in)));
  rows.push_back(row(name + ".velocity_nees", "", of(score.velocity_nees()), at_most(9.35)));
  rows.push_back(row(name + ".slips", "", of(run.slips)));
}

ExperimentOutput run_odometry(const ExperimentInput& in, const OdometryOptions& options) {
  if (!(options.distance_m >= kLeastEight_m && options.distance_m <= kMostEight_m))
    throw std::invalid_argument("--distance: expected 2 to 1000 m, found " +
                                report::number_text(options.distance_m));
  ExperimentOutput out;
  const std::vector<GaitConfig> gaits = going_gaits(in.robot, options.gait);
  const std::vector<EightRun> runs = parallel_map(
      gaits.size(), [&](std::size_t i) { return walk_eight(in, gaits[i], options.distance_m); }, in.parallel);
  for (std::size_t i = 0; i < gaits.size(); ++i) {
    add_rows(in, gaits[i], runs[i], out.rows);
    out.simulated_s += runs[i].simulated_s;
  }
  return out;
}

}  // namespace

Experiment odometry_experiment() {
  const auto options = std::make_shared<OdometryOptions>();
  Experiment out = gait_experiment("odometry", "A figure of eight, and where the robot says that it is.",
                                   "Does the robot know where it is, and how well it knows?");
  out.own.option("--gait", options->gait, "one alone; default: all that go forward");
  out.own.option("--distance", options->distance_m, "m, of each gait's way");
  out.run = [options](const ExperimentInput& in) { return run_odometry(in, *options); };
  return out;
}

}  // namespace sprung
