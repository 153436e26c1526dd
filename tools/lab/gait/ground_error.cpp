#include "tools/lab/gait/ground_error.h"

#include <cmath>

#include "simulation/hash_noise.h"
#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

constexpr double kError_m = 0.020;
constexpr double kClearOfGround_m = 0.002;  // over the highest ground: then it may move under the foot
constexpr double kMostForceRatio = 0.6, kMostOutputRatio = 0.75;
constexpr double kUneven_s = 40.0;
constexpr std::uint64_t kSignal = 0x67726f75;  // a draw of its own
constexpr GaitControl kControls[] = {GaitControl::kHybrid, GaitControl::kPreStance, GaitControl::kAdaptive};

/// Moves the ground under each foot that is above all of it, once in each swing.
class MovingGround {
 public:
  MovingGround(std::uint64_t seed, const std::vector<LegConfig>& legs)
      : seed_(seed), legs_(legs), up_(legs.size(), false), steps_(legs.size(), 0) {}

  void notice(InProcessRobot& robot) {
    for (std::size_t i = 0; i < up_.size(); ++i) {
      const TrueLeg& leg = robot.truth().legs[i];
      // A foot that bounces as it lands is above the ground too: whoever has just felt it must not lose it.
      const bool swings = robot.motion_state().legs[i].phase == LegPhase::kSwing;
      const double lowest_m = leg.true_foot_in_world_m[2] - legs_[i].foot_radius_m;
      const bool above = swings && lowest_m > kError_m + kClearOfGround_m;
      if (above && !up_[i]) set(robot, i, error_m(i));
      // A foot that is down has its next swing before it.
      if (above || leg.true_contact_force_N[2] > 0.0) up_[i] = above;
    }
  }

 private:
  double error_m(std::size_t leg) {
    const std::uint64_t which = 1000 * static_cast<std::uint64_t>(++steps_[leg]) + leg;
    return (sim::mix_bits(sim::mix_bits(seed_ ^ kSignal) ^ which) >> 63) != 0 ? kError_m : -kError_m;
  }
  static void set(InProcessRobot& robot, std::size_t leg, double height_m) {
    SimControl floor;
    floor.kind = SimControlKind::kFloor;
    floor.actuator = static_cast<int>(leg);
    floor.value = height_m;
    robot.sim().control(floor);
  }

  const std::uint64_t seed_;
  const std::vector<LegConfig>& legs_;
  std::vector<bool> up_;
  std::vector<int> steps_;
};

SimOptions plant_of(const RobotConfig& robot, const GroundErrorTask& task, const GroundCase& config) {
  if (!config.held) return lying(task.sim);
  SimOptions sim = task.sim;
  sim.plant["lying"] = 0.0;
  sim.plant["suspended"] = robot.preset(task.preset).stand_length_m + robot.legs.front().foot_radius_m;
  return sim;
}

/// A trunk that is held cannot lean, so that a gait that waits for it would wait for ever; nor has it any
/// other height.
RobotConfig robot_for(const RobotConfig& robot, const GroundCase& config) {
  RobotConfig out = robot;
  for (GaitConfig& gait : out.gaits)
    if (config.held) gait.sway_m = gait.height_m = 0.0;
  return out;
}

/// A robot that safety stopped has no touchdowns to be judged by either.
bool ended_early(const WalkVitals& vitals) { return vitals.fell || vitals.trips > 0; }

const GroundOutcome& find(const std::vector<GroundOutcome>& outcomes, const std::string& name,
                          GaitControl control) {
  for (const GroundOutcome& o : outcomes)
    if (o.name == name && o.control == control) return o;
  throw std::out_of_range("ground_error: no case " + name);
}

void add_case(const std::string& name, const GroundErrorResult& result, std::vector<ReportRow>& rows) {
  const GroundOutcome& hybrid_run = find(result.touchdowns, name, GaitControl::kHybrid);
  const GroundOutcome& adaptive_run = find(result.touchdowns, name, GaitControl::kAdaptive);
  const TouchdownPeaks hybrid = touchdown_peaks(hybrid_run.touchdowns);
  const TouchdownPeaks adaptive = touchdown_peaks(adaptive_run.touchdowns);
  const TouchdownPeaks paper = touchdown_peaks(
      find(result.touchdowns, name, GaitControl::kPreStance).touchdowns);
  rows.push_back(row("ground_error." + name + ".force_ratio", "", adaptive.worst_N / hybrid.worst_N,
                     at_most(kMostForceRatio)));
  rows.push_back(row("ground_error." + name + ".output_ratio", "", adaptive.worst_Nm / hybrid.worst_Nm,
                     at_most(kMostOutputRatio)));
  rows.push_back(row("ground_error." + name + ".mean_force_ratio", "", adaptive.mean_N / hybrid.mean_N));
  rows.push_back(row("ground_error." + name + ".mean_output_ratio", "", adaptive.mean_Nm / hybrid.mean_Nm));
  rows.push_back(row("ground_error." + name + ".paper_force_ratio", "", paper.worst_N / hybrid.worst_N));
  rows.push_back(row("ground_error." + name + ".paper_output_ratio", "", paper.worst_Nm / hybrid.worst_Nm));
  rows.push_back(row("ground_error." + name + ".adaptive_force", "N", adaptive.worst_N));
  rows.push_back(row("ground_error." + name + ".hybrid_force", "N", hybrid.worst_N));
  rows.push_back(row("ground_error." + name + ".adaptive_output", "Nm", adaptive.worst_Nm));
  rows.push_back(row("ground_error." + name + ".hybrid_output", "Nm", hybrid.worst_Nm));
  rows.push_back(row("ground_error." + name + ".adaptive_falls", "", ended_early(adaptive_run.vitals) ? 1 : 0,
                     at_most(0.0)));
  rows.push_back(row("ground_error." + name + ".hybrid_falls", "", ended_early(hybrid_run.vitals) ? 1 : 0));
}

int falls(const UnevenOutcome& outcome) {
  int count = 0;
  for (const WalkVitals& v : outcome.runs) count += ended_early(v) ? 1 : 0;
  return count;
}

report::Section touchdowns_section(const GroundErrorResult& result, const std::string& name) {
  report::Section out{"Ground 20 mm higher or lower: " + name};
  report::Table table{"",
                      {"control", "touchdowns", "worst force (N)", "mean (N)", "worst true knee output (Nm)",
                       "mean (Nm)", "fell"}};
  report::Plot force{"Touchdowns", {"time", "s"}, {"true contact force, peak", "N"}};
  for (const GroundOutcome& o : result.touchdowns) {
    if (o.name != name) continue;
    const TouchdownPeaks p = touchdown_peaks(o.touchdowns);
    table.rows.push_back({sprung::name(o.control), o.touchdowns.size(), p.worst_N, p.mean_N, p.worst_Nm,
                          p.mean_Nm, ended_early(o.vitals) ? o.vitals.why : "no"});
    report::Series series{sprung::name(o.control), {}, {}, report::Style::kPoints};
    for (const Touchdown& t : o.touchdowns) {
      series.x.push_back(t.time_s);
      series.y.push_back(t.force_N);
    }
    force.series.push_back(series);
  }
  out.tables = {table};
  out.plots = {force};
  return out;
}

report::Section uneven_section(const GroundErrorResult& result) {
  report::Section out{"Uneven floor"};
  report::Table table{"", {"gait", "speed (m/s)", "error within (mm)", "runs", "falls", "first"}};
  for (const UnevenOutcome& u : result.uneven) {
    std::string why = "-";
    for (const WalkVitals& v : u.runs)
      if (why == "-" && !v.why.empty()) why = v.why;
    table.rows.push_back({u.config.gait, u.config.speed_m_s, 1e3 * u.config.error_m, u.runs.size(),
                          report::Cell{falls(u), falls(u) == 0 ? report::Mark::kGood : report::Mark::kBad},
                          why});
  }
  out.tables = {table};
  return out;
}

}  // namespace

const std::vector<GroundCase>& ground_cases() {
  // Feet must lift by more than 40 mm to come from the lowest ground over the highest: a crawl's do.
  static const std::vector<GroundCase> cases{{"rig", "crawl", 0.0, true, 40.0},
                                             {"crawl", "crawl", 0.1, false, 40.0}};
  return cases;
}

const std::vector<UnevenCase>& uneven_cases() {
  static const std::vector<UnevenCase> cases{{"crawl", 0.1, 0.010, true},
                                             {"crawl", 0.1, 0.020, true},
                                             {"trot", 0.3, 0.010, false},
                                             {"trot", 0.3, 0.020, false}};
  return cases;
}

GroundOutcome step_on_errors(const RobotConfig& given, const GroundErrorTask& task, const GroundCase& config,
                             GaitControl control) {
  const RobotConfig robot = robot_for(given, config);
  WalkingRobot walker(robot, task.preset, plant_of(robot, task, config));
  walker.walk(config.gait, {config.speed_m_s, 0.0, 0.0}, control);
  MovingGround ground(task.ground, robot.legs);
  StepScore score(robot);
  GroundOutcome out;
  out.name = config.name;
  out.control = control;
  for (double time_s = 0.0; time_s < config.lasts_s && walker.upright(); time_s += 1.0)
    walker.run(1.0, [&](InProcessRobot& r) {
      if (!walker.upright()) return;
      ground.notice(r);
      score.add({r.joint_state(), r.leg_command(), r.motion_state(), r.truth()});
    });
  for (const Touchdown& t : score.touchdowns())
    if (std::abs(t.ground_error_m) > 0.5 * kError_m) out.touchdowns.push_back(t);
  out.vitals = walker.vitals();
  out.simulated_s = walker.simulated_s();
  return out;
}

WalkVitals walk_uneven(const RobotConfig& robot, const GroundErrorTask& task, const UnevenCase& config,
                       std::uint64_t ground, double duration_s) {
  SimOptions sim = lying(task.sim);
  sim.plant["ground_error"] = config.error_m;
  sim.plant["ground_seed"] = static_cast<double>(ground);
  WalkingRobot walker(robot, task.preset, sim);
  walker.walk(config.gait, {config.speed_m_s, 0.0, 0.0});
  for (double time_s = 0.0; time_s < duration_s && walker.upright(); time_s += 1.0) walker.run(1.0);
  WalkVitals vitals = walker.vitals();
  const MotionState& motion = walker.robot().motion_state();
  if (walker.upright() && motion.state != MotionPhase::kWalking)
    vitals.why = std::string("stopped walking: ") + motion.last_transition;
  return vitals;
}

GroundErrorResult run_ground_error(const RobotConfig& robot, const GroundErrorTask& task) {
  GroundErrorResult out;
  out.touchdowns.resize(ground_cases().size() * std::size(kControls));
  const auto grounds = static_cast<std::size_t>(task.grounds);
  std::vector<WalkVitals> uneven(uneven_cases().size() * grounds);
  run_parallel(
      out.touchdowns.size() + uneven.size(),
      [&](std::size_t i) {
        if (i < out.touchdowns.size()) {
          out.touchdowns[i] = step_on_errors(robot, task, ground_cases()[i / std::size(kControls)],
                                             kControls[i % std::size(kControls)]);
          return;
        }
        const std::size_t k = i - out.touchdowns.size();
        uneven[k] = walk_uneven(robot, task, uneven_cases()[k / grounds],
                                1000 * (task.ground + 1) + k % grounds, kUneven_s);
      },
      task.parallel);
  for (const GroundOutcome& o : out.touchdowns) out.simulated_s += o.simulated_s;
  for (std::size_t c = 0; c < uneven_cases().size(); ++c) {
    out.uneven.push_back({uneven_cases()[c], {}, 0.0});
    for (std::size_t k = 0; k < grounds; ++k) out.uneven.back().runs.push_back(uneven[c * grounds + k]);
    for (const WalkVitals& v : out.uneven.back().runs) out.simulated_s += v.watched_s;
  }
  return out;
}

std::vector<ReportRow> ground_error_rows(const GroundErrorResult& result) {
  std::vector<ReportRow> rows;
  for (const GroundCase& config : ground_cases()) add_case(config.name, result, rows);
  for (const UnevenOutcome& u : result.uneven) {
    const std::string name = u.config.gait + "_uneven_" + std::to_string(std::lround(1e3 * u.config.error_m));
    rows.push_back(
        row("ground_error." + name + ".falls", "", falls(u), demanded(u.config.demanded, at_most(0.0))));
  }
  return rows;
}

std::vector<report::Section> ground_error_sections(const GroundErrorResult& result) {
  std::vector<report::Section> out;
  for (const GroundCase& config : ground_cases()) out.push_back(touchdowns_section(result, config.name));
  out.push_back(uneven_section(result));
  return out;
}

Experiment ground_error_experiment() {
  const auto ground = std::make_shared<std::uint64_t>(GroundErrorTask{}.ground);
  Experiment out = gait_experiment(
      "ground_error",
      "Ground that lies 20 mm higher or lower than feet expect, trunk fixed and free; uneven floors.",
      "What does sprung's own pre-stance save where the ground is not where it is expected?");
  out.seed_help = "of every noise; 0 was used for tuning";
  out.own.option("--ground", *ground, "which grounds are drawn");
  out.run = [ground](const ExperimentInput& in) {
    GroundErrorTask task;
    task.ground = *ground;
    task.preset = in.preset;
    task.sim = in.sim;
    task.parallel = in.parallel;
    const GroundErrorResult result = run_ground_error(in.robot, task);
    return ExperimentOutput{ground_error_rows(result), result.simulated_s, ground_error_sections(result)};
  };
  return out;
}

}  // namespace sprung
