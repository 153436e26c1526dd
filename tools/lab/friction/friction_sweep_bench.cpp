#include "tools/lab/friction/friction_sweep_bench.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "planner/joint_limits.h"
#include "tools/lab/identify/record_in_process.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {

namespace {

/// The estimator settles; drives that came up in fault are reset; homing holds power back.
constexpr double kReady_s = 1.0;
constexpr double kHomeOnBench_s = 5.0;
/// Beyond the time that a move takes: drives are enabled before the first one.
constexpr double kEnableOnBench_s = 5.0;
constexpr double kSit_s = 10.0;
constexpr double kLoadSettle_s = 1.0;
constexpr double kForever_s = 1e6;

const LegConfig& leg_of(const RobotConfig& robot, int joint, int& leg, int& in_leg) {
  for (std::size_t l = 0; l < robot.legs.size(); ++l) {
    const std::vector<int>& joints = robot.legs[l].joints;
    const auto found = std::find(joints.begin(), joints.end(), joint);
    if (found == joints.end()) continue;
    leg = static_cast<int>(l);
    in_leg = static_cast<int>(found - joints.begin());
    return robot.legs[l];
  }
  throw std::invalid_argument("joint " + std::to_string(joint) + " belongs to no leg");
}

Transmission transmission_of(const RobotConfig& robot, int joint, int& leg, int& in_leg) {
  return Transmission(leg_of(robot, joint, leg, in_leg));
}

/// A robot that could fall hangs: its joints then turn freely, as on a bench.
SimOptions on_a_bench(const RobotConfig& robot, SimOptions sim) {
  if (robot.body.mass_kg > 0.0) sim.plant.emplace("suspended", identify::hanging_height_m(robot));
  return sim;
}

}  // namespace

int bench_joint(const RobotConfig& robot, const std::string& joint_name) {
  std::string names;
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const std::string& name = robot.joints[j].name;
    const bool is_knee = name.find("knee") != std::string::npos;
    if (joint_name.empty() ? is_knee || robot.joints.size() == 1 : name == joint_name)
      return static_cast<int>(j);
    names += (names.empty() ? "" : ", ") + name;
  }
  throw std::invalid_argument((joint_name.empty() ? "--joint: which one? " + robot.name
                                                  : "no joint '" + joint_name + "': " + robot.name) +
                              " has " + names);
}

BenchLimits bench_limits(const RobotConfig& robot, int joint) {
  int leg = 0, in_leg = 0;
  const LegConfig& config = leg_of(robot, joint, leg, in_leg);
  const JointLimits limits = joint_limits(robot)[joint];
  const auto actuator = static_cast<std::size_t>(config.actuators[static_cast<std::size_t>(in_leg)]);
  const ActuatorConfig& a = robot.actuators[actuator];
  return {limits.position_min_rad, limits.position_max_rad, limits.speed_rad_s, limits.acceleration_rad_s2,
          a.gear_ratio * a.torque_constant_Nm_A * a.rated_current_A};
}

JointBench::JointBench(const RobotConfig& robot, const std::string& preset, const SimOptions& sim, int joint)
    : config_(robot),
      robot_(robot, preset, on_a_bench(robot, sim)),
      index_(static_cast<std::size_t>(joint)),
      transmission_(transmission_of(robot, joint, leg_, in_leg_)) {
  robot_.boot(10.0);
  run(kReady_s);
}

void JointBench::home() {
  bool all = true;
  for (const ActuatorState& actuator : robot_.drive_state().actuators) all = all && actuator.referenced;
  if (all) return;
  ask(scripted(OperatorKind::kHome, robot_.cycle() + 1), kHomeOnBench_s, {});
  run(kReady_s);
}

void JointBench::move(double target_rad, double speed_rad_s, double acceleration_rad_s2,
                      const Observer& observe) {
  OperatorCommand command = scripted(OperatorKind::kMoveJoint, robot_.cycle() + 1);
  command.joint = static_cast<std::int32_t>(index_);
  command.joint_target_rad = target_rad;
  command.joint_speed_rad_s = speed_rad_s;
  command.joint_acceleration_rad_s2 = acceleration_rad_s2;
  const double way_rad = std::abs(target_rad - sample().position_rad);
  ask(command, kEnableOnBench_s + way_rad / speed_rad_s + 2.0 * speed_rad_s / acceleration_rad_s2, observe);
}

void JointBench::sit() { ask(scripted(OperatorKind::kSit, robot_.cycle() + 1), kSit_s, {}); }

void JointBench::run(double seconds, const Observer& observe) {
  for (std::int64_t i = std::llround(seconds / config_.cycle_s); i > 0; --i) tick(observe);
}

void JointBench::tick(const Observer& observe) {
  robot_.tick();
  if (robot_.sim().failed())
    throw std::runtime_error(std::string("the simulated plant failed: ") + robot_.sim().failure());
  if (observe) observe(*this);
}

void JointBench::ask(const OperatorCommand& command, double timeout_s, const Observer& observe) {
  robot_.submit(command);
  for (std::int64_t i = std::llround(timeout_s / config_.cycle_s); i > 0; --i) {
    tick(observe);
    for (OperatorReply reply; robot_.next_reply(reply);) {
      if (reply.request_id != command.request_id) continue;
      if (reply.outcome == OperatorOutcome::kDone) return;
      if (reply.outcome == OperatorOutcome::kRefused || reply.outcome == OperatorOutcome::kFailed)
        throw std::runtime_error(std::string("the robot ") + name(reply.outcome) + " '" + name(command.kind) +
                                 "': " + reply.reason +
                                 " (safety: " + robot_.bridge().safety().detail.data() + ")");
    }
  }
  throw std::runtime_error(std::string("no answer to '") + name(command.kind) + "' in time");
}

void JointBench::load(double torque_Nm, double duration_s) {
  SimControl control;
  control.kind = SimControlKind::kWrench;
  control.apply_at_seq = robot_.cycle() + 1;
  control.actuator = leg_;
  control.wrench = {0, 0, 0, 0, load_sense_ * torque_Nm, 0};
  control.duration_s = duration_s > 0.0 ? duration_s : kForever_s;
  robot_.sim().control(control);
}

double JointBench::mean_motor_torque_Nm(double seconds) {
  double sum_Nm = 0.0;
  run(seconds, [&](JointBench& bench) { sum_Nm += bench.sample().motor_torque_Nm; });
  return sum_Nm * config_.cycle_s / seconds;
}

void JointBench::find_load_sense(double torque_Nm) {
  load_sense_ = 1.0;
  double held_Nm[2];
  for (int i = 0; i < 2; ++i) {
    load(i == 0 ? torque_Nm : -torque_Nm);
    run(kLoadSettle_s);
    held_Nm[i] = mean_motor_torque_Nm(kLoadSettle_s);
  }
  load(0.0);
  run(kLoadSettle_s);
  // The motor holds against the load; friction may hold a part of it for the motor.
  const double change_Nm = held_Nm[0] - held_Nm[1];
  if (std::abs(change_Nm) < torque_Nm)
    throw std::runtime_error(
        "a torque about the lateral axis does not reach this joint: take a hip, knee or arm");
  load_sense_ = change_Nm < 0.0 ? 1.0 : -1.0;
}

BenchSample JointBench::sample() const {
  const LegConfig& leg = config_.legs[leg_];
  JointVector position_rad(transmission_.size()), torque_Nm(transmission_.size());
  for (int i = 0; i < transmission_.size(); ++i) {
    const auto a = static_cast<std::size_t>(leg.actuators[static_cast<std::size_t>(i)]);
    const ActuatorConfig& actuator = config_.actuators[a];
    const ActuatorState& state = robot_.drive_state().actuators[a];
    position_rad[i] = state.measured_position_rad;
    torque_Nm[i] = actuator.gear_ratio * actuator.torque_constant_Nm_A * state.measured_current_A;
  }
  return {time_s(), transmission_.joint_from_actuator(position_rad)[in_leg_],
          transmission_.joint_torque(torque_Nm)[in_leg_]};
}

namespace {

constexpr double kApproach_rad_s = 1.0;
constexpr double kApproach_rad_s2 = 10.0;
constexpr double kThere_rad = 0.01;
constexpr double kRestAtEnd_s = 0.1;
/// Well above breakaway friction of the shipped robots' gears.
constexpr double kSenseOfRated = 0.6;

/// Everything between the ends of a pass.
struct Steady {
  std::vector<BenchSample> samples;
  std::vector<double> sensed_Nm;
  double true_friction_Nm = 0.0;
};

Steady drive_pass(JointBench& bench, const SweepPass& pass, const SteadySpan& span) {
  Steady out;
  const double began_s = bench.time_s();
  bench.move(pass.to_rad, pass.speed_rad_s, pass.acceleration_rad_s2, [&](JointBench& b) {
    const double since_s = b.time_s() - began_s;
    if (since_s < span.from_s || since_s >= span.to_s) return;
    out.samples.push_back(b.sample());
    const TorqueSensor& sensor = b.robot().sim().torque_sensor();
    if (sensor.joint >= 0) out.sensed_Nm.push_back(sensor.measured_torque_Nm);
    out.true_friction_Nm += b.truth().true_friction_torque_Nm;
  });
  if (out.samples.size() < 2) throw std::runtime_error("no samples at constant speed");
  out.true_friction_Nm /= static_cast<double>(out.samples.size());
  return out;
}

RecordedPass thinned(const SweepPass& pass, const Steady& steady, std::size_t wanted) {
  RecordedPass out;
  out.pass = pass;
  const BenchSample& first = steady.samples.front();
  const BenchSample& last = steady.samples.back();
  out.velocity_rad_s = (last.position_rad - first.position_rad) / (last.time_s - first.time_s);
  out.true_friction_Nm = steady.true_friction_Nm;
  for (const std::size_t i : evenly_picked(steady.samples.size(), wanted)) {
    const BenchSample& sample = steady.samples[i];
    out.time_s.push_back(sample.time_s);
    out.position_rad.push_back(sample.position_rad);
    out.motor_torque_Nm.push_back(sample.motor_torque_Nm);
    if (!steady.sensed_Nm.empty()) out.sensed_torque_Nm.push_back(steady.sensed_Nm[i]);
  }
  return out;
}

bool loads_anything(const SweepPlan& plan) {
  for (const SweepPass& pass : plan.passes) {
    if (pass.load_Nm != 0.0) return true;
  }
  return false;
}

void approach(JointBench& bench, double target_rad) {
  if (std::abs(bench.sample().position_rad - target_rad) > kThere_rad)
    bench.move(target_rad, kApproach_rad_s, kApproach_rad_s2);
  bench.run(kRestAtEnd_s);
}

double gear_ratio_of(const RobotConfig& robot, int joint) {
  for (const LegConfig& leg : robot.legs) {
    for (std::size_t i = 0; i < leg.joints.size(); ++i) {
      if (leg.joints[i] == joint) return robot.actuators[leg.actuators[i]].gear_ratio;
    }
  }
  return 0.0;
}

}  // namespace

SweepRecording record_sweep(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                            int joint, SweepProtocol protocol, const SweepPlan& plan) {
  JointBench bench(robot, preset, sim, joint);
  bench.home();
  SweepRecording out;
  out.protocol = protocol;
  out.robot = robot.name;
  out.joint = robot.joints[joint].name;
  out.gear_ratio = gear_ratio_of(robot, joint);
  out.seed = sim.seed;
  // The first move also enables the drives, and holds the joint where it is.
  approach(bench, plan.passes.front().from_rad);
  if (loads_anything(plan)) bench.find_load_sense(kSenseOfRated * bench_limits(robot, joint).rated_torque_Nm);
  double load_Nm = 0.0;
  for (const SweepPass& pass : plan.passes) {
    if (pass.load_Nm != load_Nm) bench.load(load_Nm = pass.load_Nm);
    approach(bench, pass.from_rad);
    out.passes.push_back(
        thinned(pass, drive_pass(bench, pass, steady_span(pass, plan.mirrored)), plan.samples_a_pass));
  }
  out.simulated_s = bench.time_s();
  return out;
}

}  // namespace sprung
