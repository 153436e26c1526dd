#include "tools/lab/gait/walk_experiment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "model/leg_kinematics.h"
#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

constexpr WalkControl kWalkControls[] = {{GaitControl::kForce, false},
                                         {GaitControl::kForce},
                                         {GaitControl::kHybrid},
                                         {GaitControl::kPreStance},
                                         {GaitControl::kAdaptive}};
constexpr const char* kCompared = "walk";
constexpr double kStarting_s = 2.0, kMeasured_s = 9.0;
constexpr double kTraced_s = 2.0;
/// Of S1's force control, and no worse than one that feeds forward what the position loops get.
constexpr double kMostOverPlainForce = 0.35, kMostOverForce = 1.0;
/// [design choice] Of robot.yaml's torque limit: a fifth is left for who pushes the robot.
constexpr double kTorqueShare = 0.8;
constexpr const char* kReserveNote =
    "Voltage reserve: 1 - |R i + Ke w| / (0.9 U), true, least of all joints from the first step on.";
/// Of the estimated velocity; what a push adds is in no gait's way.
constexpr double kMostVelocityRms_mm_s = 50.0;
constexpr double kSpeedShare = 0.10, kMostDrift_deg = 5.0;
/// Of the gait's fastest, that speed and heading are taken at.
constexpr double kCrawlShare = 20.0 / 21.0, kWalkShare = 20.0 / 21.0, kTrotShare = 7.0 / 8.0,
                 kStretchShare = 1.0;
constexpr double kSpeedStep_m_s = 0.005;
constexpr double kTimeout = 2.0;
constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// Of the trunk.
class VelocityScore {
 public:
  void add(const JointState& state, const SimTruth& truth) {
    const auto& q = truth.base_quaternion_wxyz;
    const Eigen::Vector3d true_m_s = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).conjugate() *
                                     to_eigen(truth.base_velocity_m_s);
    const Eigen::Vector3d estimated_m_s = to_eigen(state.body.estimated_velocity_m_s);
    squares_m2_s2_ += (estimated_m_s - true_m_s).squaredNorm();
    true_m_s_ += true_m_s.x();
    estimated_m_s_ += estimated_m_s.x();
    ++cycles_;
  }
  double rms_m_s() const { return std::sqrt(squares_m2_s2_ / cycles_); }
  double off() const { return estimated_m_s_ / true_m_s_ - 1.0; }

 private:
  double squares_m2_s2_ = 0.0, true_m_s_ = 0.0, estimated_m_s_ = 0.0;
  int cycles_ = 0;
};

void trace(const InProcessRobot& robot, double time_s, FootTrace& out) {
  const Vec3& wanted = robot.leg_command().legs.front().desired_foot_in_hip_m;
  const Vec3& foot = robot.joint_state().legs.front().estimated_foot_in_hip_m;
  out.time_s.push_back(time_s);
  out.wanted_x_m.push_back(wanted[0]);
  out.wanted_z_m.push_back(wanted[2]);
  out.foot_x_m.push_back(foot[0]);
  out.foot_z_m.push_back(foot[2]);
  out.force_N.push_back(robot.truth().legs.front().true_contact_force_N[2]);
}

/// A share of the gait's fastest speed in robot.yaml, as somebody would type it.
double speed_of(const RobotConfig& robot, const char* gait, double share) {
  const double fastest_m_s = robot.gaits[gait_index(robot, gait)].fastest_forward_m_s;
  const double steps_per_m_s = std::round(1.0 / kSpeedStep_m_s);
  return std::round(share * fastest_m_s * steps_per_m_s) / steps_per_m_s;
}

const char* row_name(const WalkControl& control) {
  switch (control.control) {
    case GaitControl::kForce:
      return control.feeds_inertia ? "force" : "force_plain";
    case GaitControl::kHybrid:
      return "hybrid";
    case GaitControl::kPreStance:
      return "prestance";
    case GaitControl::kAdaptive:
      break;
  }
  return "adaptive";
}

/// RMS in swing of one control over another's; NaN where it did not arrive, or the other one never swung.
double swing_ratio(const ControlOutcome& of, const ControlOutcome& over) {
  const bool arrived = !of.vitals.fell && of.vitals.trips == 0;
  return arrived ? of.swing_rms_m / over.swing_rms_m : kNaN;
}

void add_control(const ControlOutcome& c, const WalkExperiment& all, std::vector<ReportRow>& rows) {
  const std::string name = std::string("walk.") + row_name(c.control);
  rows.push_back(row(name + ".swing_rms", "mm", 1e3 * c.swing_rms_m));
  rows.push_back(row(name + ".touchdown_peak", "N", c.peaks.mean_N));
  rows.push_back(row(name + ".touchdown_worst", "N", c.peaks.worst_N));
  rows.push_back(row(name + ".knee_output_peak", "Nm", c.peaks.mean_Nm));
  rows.push_back(row(name + ".fell", "", c.vitals.fell ? 1 : 0));
  if (c.control.control == GaitControl::kForce) return;
  for (const ControlOutcome& force : all.controls) {
    if (force.control.control != GaitControl::kForce) continue;
    const bool plain = !force.control.feeds_inertia, demands = c.control.control == GaitControl::kHybrid;
    rows.push_back(row(name + (plain ? ".swing_ratio_plain" : ".swing_ratio"), "", swing_ratio(c, force),
                       demanded(demands, at_most(plain ? kMostOverPlainForce : kMostOverForce))));
  }
}

void add_gait(const GaitOutcome& g, double torque_limit_Nm, std::vector<ReportRow>& rows) {
  const std::string name = g.config.name;
  const bool arrived = !g.vitals.fell && g.vitals.trips == 0;
  const auto bounds = [&](const Bounds& wanted) { return demanded(g.config.demanded, wanted); };
  rows.push_back(row("walk." + name + ".speed", "mm/s", arrived ? 1e3 * g.speed_m_s : kNaN,
                     bounds(between(1e3 * (1.0 - kSpeedShare) * g.config.speed_m_s,
                                    1e3 * (1.0 + kSpeedShare) * g.config.speed_m_s))));
  rows.push_back(row("walk." + name + ".drift", "deg", arrived ? std::abs(g.drift_rad) * kDegrees : kNaN,
                     bounds(at_most(kMostDrift_deg))));
  rows.push_back(row("walk." + name + ".joint_speed_max", "rad/s", g.vitals.fastest_rad_s));
  rows.push_back(row("walk." + name + ".motor_torque_max", "Nm", g.vitals.strongest_Nm,
                     bounds(at_most(torque_limit_Nm))));
  rows.push_back(row("walk." + name + ".saturated", "%", 100.0 * g.vitals.saturated_share));
  if (std::isfinite(g.reserve.least))
    rows.push_back(row("walk." + name + ".voltage_reserve", "%", 100.0 * g.reserve.least,
                       at_least(100.0 * VoltageReserve::kWanted)));
  rows.push_back(row("walk." + name + ".velocity_rms", "mm/s", arrived ? 1e3 * g.velocity_rms_m_s : kNaN,
                     bounds(at_most(kMostVelocityRms_mm_s))));
  rows.push_back(row("walk." + name + ".velocity_off", "%", 100.0 * g.velocity_off));
  if (std::isfinite(g.power_W)) {
    rows.push_back(row("walk." + name + ".power", "W", arrived ? g.power_W : kNaN));
    rows.push_back(row("walk." + name + ".transport_cost", "", arrived ? g.transport_cost : kNaN));
  }
  rows.push_back(row("walk." + name + ".trips", "", g.vitals.trips, bounds(at_most(0.0))));
}

report::Section controls_section(const WalkExperiment& result) {
  report::Section out{"Feet in swing, and touchdowns"};
  report::Table table{
      std::string("Gait ") + kCompared + ", " + report::number_text(result.limits.compared_m_s) + " m/s",
      {"control", "swing RMS (mm)", "touchdown, mean (N)", "worst (N)", "knee's true gear output, mean (Nm)",
       "touchdowns", "fell"}};
  report::Plot height{"Left front foot", {"time", "s"}, {"height in hip axes", "m"}};
  report::Plot force{"Left front foot's true contact force", {"time", "s"}, {"vertical", "N"}};
  int colour = 0;
  for (const ControlOutcome& c : result.controls) {
    table.rows.push_back({row_name(c.control), 1e3 * c.swing_rms_m, c.peaks.mean_N, c.peaks.worst_N,
                          c.peaks.mean_Nm, c.touchdowns, c.vitals.fell ? "yes" : "no"});
    const std::string name = row_name(c.control);
    height.series.push_back({name, c.trace.time_s, c.trace.foot_z_m, report::Style::kLine, colour});
    height.series.push_back(
        {name + ", wanted", c.trace.time_s, c.trace.wanted_z_m, report::Style::kDashedLine, colour});
    force.series.push_back({name, c.trace.time_s, c.trace.force_N, report::Style::kLine, colour++});
  }
  out.tables = {table};
  out.plots = {height, force};
  return out;
}

report::Section gaits_section(const WalkExperiment& result) {
  report::Section out{"Speed and heading"};
  report::Table table{
      "From when the speed is reached",
      {"gait", "asked (m/s)", "speed (m/s)", "over (m)", "turned (deg)", "joint speed, most (rad/s)",
       "motor torque, most (Nm)", "at a limit (%)", "voltage reserve, least (%)", "of", "power (W)",
       "cost of transport", "what befell it"}};
  for (const GaitOutcome& g : result.gaits)
    table.rows.push_back({g.config.gait, g.config.speed_m_s, g.speed_m_s, g.distance_m,
                          g.drift_rad * kDegrees, g.vitals.fastest_rad_s, g.vitals.strongest_Nm,
                          100.0 * g.vitals.saturated_share, 100.0 * g.reserve.least, g.reserve.actuator,
                          g.power_W, g.transport_cost, g.vitals.why.empty() ? "nothing" : g.vitals.why});
  table.note = "The drives' no-load speed is " + report::number_text(result.limits.speed_rad_s) + " rad/s. " +
               kReserveNote + " Power: all that is taken from the supply, " +
               report::number_text(TransportCost::kComputer_W) + " W for the computer and " +
               report::number_text(TransportCost::kDrive_W) +
               " W for each drive included; over weight and speed it is the cost of transport.";
  out.tables = {table};
  return out;
}

}  // namespace

std::vector<GaitCase> gait_cases(const RobotConfig& robot) {
  return {{"crawl", "crawl", speed_of(robot, "crawl", kCrawlShare), true},
          {"walk", "walk", speed_of(robot, "walk", kWalkShare), true},
          {"trot", "trot", speed_of(robot, "trot", kTrotShare), true},
          {"trot_stretch", "trot", speed_of(robot, "trot", kStretchShare), false}};
}

WalkLimits walk_limits(const RobotConfig& robot) {
  WalkLimits out;
  out.compared_m_s = speed_of(robot, kCompared, kWalkShare);
  out.torque_Nm = std::numeric_limits<double>::infinity();
  for (const ActuatorConfig& actuator : robot.actuators) {
    out.speed_rad_s = std::max(out.speed_rad_s, actuator.speed_limit_rad_s);
    out.torque_Nm = std::min(out.torque_Nm, kTorqueShare * actuator.torque_limit_Nm);
  }
  return out;
}

ControlOutcome walk_under(RobotConfig robot, const WalkTask& task, const WalkControl& control) {
  if (!control.feeds_inertia)
    for (PresetConfig& preset : robot.presets) preset.walk.swing_inertia_compensation = 0.0;
  WalkingRobot walker(robot, task.preset, lying(task.sim));
  walker.walk(kCompared, {speed_of(robot, kCompared, kWalkShare), 0.0, 0.0}, control.control);
  walker.run(kStarting_s);
  ControlOutcome out;
  out.control = control;
  StepScore score(robot);
  double time_s = 0.0;
  walker.run(kMeasured_s, [&](InProcessRobot& r) {
    if (!walker.upright()) return;
    score.add({r.joint_state(), r.leg_command(), r.motion_state(), r.truth()});
    if (time_s < kTraced_s) trace(r, time_s, out.trace);
    time_s += robot.cycle_s;
  });
  out.swing_rms_m = score.swing_rms_m();
  out.peaks = touchdown_peaks(score.touchdowns());
  out.touchdowns = static_cast<int>(score.touchdowns().size());
  out.vitals = walker.vitals();
  out.simulated_s = walker.simulated_s();
  return out;
}

GaitOutcome go(const RobotConfig& robot, const WalkTask& task, const GaitCase& config) {
  WalkingRobot walker(robot, task.preset, lying(task.sim));
  walker.walk(config.gait, {config.speed_m_s, 0.0, 0.0});
  walker.run(speed_reached_s(robot, task.preset, config.gait, {config.speed_m_s, 0.0, 0.0}));
  TravelScore travel;
  VelocityScore velocity;
  TransportCost cost(robot, lying(task.sim));
  const double longest_s = kTimeout * task.distance_m / config.speed_m_s;
  for (double time_s = 0.0; time_s < longest_s && walker.upright(); time_s += 0.1) {
    walker.run(0.1, [&](InProcessRobot& r) {
      travel.add(r.truth(), robot.cycle_s);
      velocity.add(r.joint_state(), r.truth());
      cost.add(r.truth());
    });
    if (travel.distance_m() >= task.distance_m) break;
  }
  return {config,          travel.speed_m_s(),   travel.drift_rad(),         travel.distance_m(),
          walker.vitals(), walker.simulated_s(), walker.reserve(),           velocity.rms_m_s(),
          velocity.off(),  cost.mean_W(),        cost.at(travel.speed_m_s())};
}

WalkExperiment run_walk_experiment(const RobotConfig& robot, const WalkTask& task) {
  if (!(task.distance_m > 0.0)) throw std::invalid_argument("--distance must be more than 0 m");
  const std::vector<GaitCase> cases = gait_cases(robot);
  WalkExperiment out;
  out.limits = walk_limits(robot);
  out.gaits.resize(cases.size());
  out.controls.resize(std::size(kWalkControls));
  const std::vector<Manoeuvre> directions = manoeuvres(robot);
  out.manoeuvres.resize(directions.size());
  const std::size_t before = out.gaits.size() + out.controls.size();
  run_parallel(
      before + directions.size(),
      [&](std::size_t i) {
        if (i < out.gaits.size())
          out.gaits[i] = go(robot, task, cases[i]);
        else if (i < before)
          out.controls[i - out.gaits.size()] = walk_under(robot, task, kWalkControls[i - out.gaits.size()]);
        else
          out.manoeuvres[i - before] = manoeuvre(robot, task.preset, task.sim, directions[i - before]);
      },
      task.parallel);
  for (const GaitOutcome& g : out.gaits) out.simulated_s += g.simulated_s;
  for (const ControlOutcome& c : out.controls) out.simulated_s += c.simulated_s;
  for (const ManoeuvreOutcome& m : out.manoeuvres) out.simulated_s += m.simulated_s;
  return out;
}

std::vector<ReportRow> walk_rows(const WalkExperiment& result) {
  std::vector<ReportRow> rows;
  for (const ControlOutcome& c : result.controls) add_control(c, result, rows);
  for (const GaitOutcome& g : result.gaits) add_gait(g, result.limits.torque_Nm, rows);
  for (ReportRow& one : manoeuvre_rows(result.manoeuvres)) rows.push_back(std::move(one));
  return rows;
}

std::vector<report::Section> walk_sections(const WalkExperiment& result) {
  return {controls_section(result), gaits_section(result), manoeuvre_section(result.manoeuvres)};
}

Experiment walk_experiment() {
  const auto distance_m = std::make_shared<double>(WalkTask{}.distance_m);
  Experiment out = gait_experiment("walk",
                                   "Feet in swing and touchdowns in force control, hybrid control and with "
                                   "pre-stance; speed and heading of "
                                   "the gaits.",
                                   "How well do feet follow in each kind of control, how hard do they land, "
                                   "and how straight and fast does "
                                   "it go?");
  out.own.option("--distance", *distance_m, "m, over which speed and heading are taken");
  out.run = [distance_m](const ExperimentInput& in) {
    const WalkExperiment result = run_walk_experiment(in.robot,
                                                      {in.preset, in.sim, *distance_m, in.parallel});
    return ExperimentOutput{walk_rows(result), result.simulated_s, walk_sections(result)};
  };
  return out;
}

}  // namespace sprung
