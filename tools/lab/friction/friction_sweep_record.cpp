#include "tools/lab/friction/friction_sweep_record.h"

#include <cmath>
#include <stdexcept>

namespace sprung {
namespace {

constexpr double kApproach_rad_s = 1.0;
constexpr double kApproach_rad_s2 = 10.0;
constexpr double kThere_rad = 0.01;
constexpr double kRest_s = 0.1;
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
  bench.run(kRest_s);
}

double gear_ratio_of(const RobotConfig& robot, int joint) {
  for (const LegConfig& leg : robot.legs) {
    for (std::size_t i = 0; i < leg.joints.size(); ++i) {
      if (leg.joints[i] == joint)
        return robot.actuators[static_cast<std::size_t>(leg.actuators[i])].gear_ratio;
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
  out.joint = robot.joints[static_cast<std::size_t>(joint)].name;
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
