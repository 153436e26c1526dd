#include "tools/lab/bench/stack_bench.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "controller/controller_core.h"
#include "drivers/bridge/bridge_core.h"
#include "estimator/estimator_core.h"
#include "planner/gait/force_distribution.h"
#include "planner/planner_core.h"
#include "signals/quantile.h"
#include "simulation/plant/plant_model.h"
#include "simulation/plant/sim_config.h"
#include "simulation/sim_core.h"
#include "tools/lab/bench/stopwatch.h"

namespace sprung {
namespace {

constexpr double kBoot_s = 10.0;
constexpr double kHomeStack_s = 0.5;
constexpr double kRise_s = 1.0;      // beside the preset's rise_time
constexpr double kGetGoing_s = 1.0;  // until it walks
constexpr double kSpeed = 0.5;       // of the gait's fastest
constexpr int kCalls = 2000;

enum Part { kSimulation, kBridge, kEstimator, kPlanner, kController, kPartCount };
constexpr std::array<const char*, kPartCount> kPartNames{"simulation", "bridge", "estimator", "planner",
                                                         "controller"};

/// The cores as InProcessRobot calls them, with a watch on each.
class TimedStack {
 public:
  TimedStack(const RobotConfig& robot, const SimOptions& sim)
      : robot_(robot),
        cycle_us_(std::llround(robot.cycle_s * 1e6)),
        bridge_(robot, BridgeOptions{robot.watchdogs}),
        sim_(robot, sim),
        estimator_(robot),
        planner_(robot, robot.preset()),
        controller_(robot, robot.preset(), robot.watchdogs),
        drive_state_(robot.actuators.size()),
        joint_state_(robot.joints.size(), robot.legs.size()),
        leg_command_(robot.legs.size()),
        motion_state_(robot.legs.size()),
        drive_command_(robot.actuators.size()) {}

  void stand_up() {
    for (int left = static_cast<int>(kBoot_s / robot_.cycle_s); !bridge_.operational(); --left) {
      if (left == 0) throw std::runtime_error(bridge_.boot_detail());
      tick();
    }
    run(kHomeStack_s);
    ask(OperatorKind::kHome);
    run(kHomeStack_s);
    ask(OperatorKind::kStand);
    run(robot_.preset().rise_time_s + kRise_s);
    expect(MotionPhase::kStanding);
  }
  void walk(int gait, double speed_m_s) {
    OperatorCommand command;
    command.kind = OperatorKind::kWalk;
    command.gait = gait;
    command.walk_speed[0] = speed_m_s;
    ask(command);
    run(kGetGoing_s);
  }
  void run(double seconds) {
    for (long i = std::lround(seconds / robot_.cycle_s); i > 0; --i) tick();
  }
  void expect(MotionPhase state) const {
    if (motion_state_.state != state)
      throw std::runtime_error(std::string("the robot does not do as told: ") +
                               motion_state_.last_transition);
  }
  void forget_times() {
    for (auto& times : ns_) times.clear();
    cores_us_.clear();
  }
  /// Processor time of estimator, planner and controller, a cycle each.
  const std::vector<double>& cores_us() const { return cores_us_; }
  double median_us(Part part) const { return 1e-3 * median(ns_[part]); }

 private:
  template <class Work>
  void timed(Part part, Work&& work) {
    const double ns = time_ns(work);
    part_ns_[part] += ns;
  }
  void ask(OperatorKind kind) {
    OperatorCommand command;
    command.kind = kind;
    ask(command);
  }
  void ask(OperatorCommand command) {
    command.request_id = ++said_;
    if (command.kind == OperatorKind::kHome) {
      (void)bridge_.operator_command(command, time_us_);
    } else {
      planner_.submit(command);
    }
  }
  void tick() {
    part_ns_.fill(0.0);
    time_us_ += cycle_us_;
    timed(kBridge, [this] { bridge_.begin_tick(time_us_, to_drives_); });
    timed(kSimulation, [this] {
      sim_.receive_burst(to_drives_, time_us_ - cycle_us_, time_us_);
      to_drives_.clear();
      from_drives_.clear();
      sim_.advance_to(time_us_, from_drives_);
    });
    bool cyclic = false;
    timed(kBridge, [&] {
      for (const BusFrame& answer : from_drives_) bridge_.receive(answer.bus, answer.frame, time_us_);
      cyclic = bridge_.end_sampling(time_us_, drive_state_);
    });
    if (cyclic) {
      const double began_s = processor_s();
      run_cores();
      cores_us_.push_back(1e6 * (processor_s() - began_s));
      timed(kBridge, [&] { bridge_.command(drive_command_, time_us_); });
    }
    timed(kBridge, [this] { bridge_.emit_setpoints(time_us_, to_drives_); });
    for (std::size_t i = 0; i < ns_.size(); ++i) ns_[i].push_back(part_ns_[i]);
  }
  void run_cores() {
    const Imu* imu = sim_.imu().stamp.seq >= 0 ? &sim_.imu() : nullptr;
    const LegCommand* legs = leg_command_.stamp.seq >= 0 ? &leg_command_ : nullptr;
    timed(kEstimator, [&] { estimator_.step(drive_state_, joint_state_, imu); });
    timed(kController, [&] { controller_.step(joint_state_, legs, drive_command_); });
    timed(kPlanner, [&] { planner_.step(joint_state_, leg_command_, motion_state_); });
  }

  const RobotConfig& robot_;
  std::int64_t cycle_us_;
  std::int64_t time_us_ = 0;
  std::int64_t said_ = 0;
  BridgeCore bridge_;
  SimCore sim_;
  EstimatorCore estimator_;
  PlannerCore planner_;
  ControllerCore controller_;
  DriveState drive_state_;
  JointState joint_state_;
  LegCommand leg_command_;
  MotionState motion_state_;
  DriveCommand drive_command_;
  FrameBatch to_drives_, from_drives_;
  std::array<double, kPartCount> part_ns_{};
  std::array<std::vector<double>, kPartCount> ns_;
  std::vector<double> cores_us_;
};

/// Two feet in a diagonal, or all four, under a body that leans a little.
double distribution_us(const RobotConfig& robot, bool diagonal) {
  ForceDistribution distribution(robot.preset().walk.floor_friction);
  const double weight_N = 9.81 * robot.body.mass_kg;
  std::vector<FootLoad> feet(robot.legs.size());
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const auto& hip_m = robot.legs[i].hip_in_trunk_m;
    feet[i].foot_from_com_m = {hip_m[0], hip_m[1], -robot.preset().stand_length_m};
    feet[i].most_N = 2.0 * weight_N;
    feet[i].stands = !diagonal || i == 0 || i == 3;
  }
  BodyWrench wanted;
  double sum_N = 0.0;
  std::vector<double> ns;
  for (int i = 0; i < kCalls; ++i) {
    const double sway = std::sin(0.01 * i);
    wanted.force_N = {20.0 * sway, 5.0 * sway, weight_N * (1.0 + 0.2 * sway)};
    wanted.torque_Nm = {10.0 * sway, -8.0 * sway, 0.0};
    ns.push_back(time_ns([&] { sum_N += distribution.solve(wanted, feet).reached.force_N.z(); }));
  }
  keep(static_cast<std::uint64_t>(sum_N));
  return 1e-3 * median(ns);
}

/// Standing, its joints held as robot.yaml's position loops do: us of mj_step a cycle of the robot.
double bare_step_us(const RobotConfig& robot) {
  const sim::PlantConfig config = sim::load_sim_config(robot, {{"lying", 0.0}}).plant;
  const sim::PlantModel plant = sim::load_plant_model(robot, config);
  const sim::DataPtr data(mj_makeData(plant.model.get()));
  for (std::size_t j = 0; j < robot.joints.size(); ++j)
    data->qpos[plant.index.joint_qpos[j]] = config.joints[j].initial_rad;
  data->qpos[plant.index.free_qpos + 2] = robot.preset().stand_length_m;
  std::vector<double> us;
  us.reserve(kCalls);
  const int steps = static_cast<int>(std::lround(robot.cycle_s / config.step_s));
  for (int cycle = 0; cycle < kCalls; ++cycle) {
    us.push_back(1e-3 * time_ns([&] {
                   for (int i = 0; i < steps; ++i) {
                     for (std::size_t j = 0; j < robot.joints.size(); ++j) {
                       const ActuatorConfig& a = robot.actuators[j];
                       const double away_rad = data->qpos[plant.index.joint_qpos[j]] -
                                               config.joints[j].initial_rad;
                       const int dof = plant.index.joint_dof[j];
                       data->qfrc_applied[dof] = -a.position_stiffness_Nm_rad * away_rad -
                                                 a.position_damping_Nm_s_rad * data->qvel[dof];
                     }
                     mj_step(plant.model.get(), data.get());
                   }
                 }));
  }
  return median(us);
}

int fastest_gait(const RobotConfig& robot) {
  const auto slower = [](const GaitConfig& a, const GaitConfig& b) {
    return a.fastest_forward_m_s < b.fastest_forward_m_s;
  };
  if (robot.gaits.empty()) throw std::invalid_argument(robot.name + " has no gaits");
  return static_cast<int>(std::max_element(robot.gaits.begin(), robot.gaits.end(), slower) -
                          robot.gaits.begin());
}

}  // namespace

std::vector<ReportRow> bench_stack(const RobotConfig& robot, double seconds) {
  const int gait = fastest_gait(robot);
  SimOptions options;
  options.plant = {{"lying", 1.0}};
  TimedStack stack(robot, options);
  stack.stand_up();
  stack.forget_times();
  stack.run(1.0);
  const double bare_us = bare_step_us(robot);
  const double standing_us = stack.median_us(kSimulation);
  double standing_stack_us = 0.0;
  for (int part = 0; part < kPartCount; ++part) standing_stack_us += stack.median_us(static_cast<Part>(part));
  stack.walk(gait, kSpeed * robot.gaits[gait].fastest_forward_m_s);
  stack.forget_times();
  const double reference_us = 1e-3 * reference_ns();
  const double began_s = processor_s();
  stack.run(seconds);
  const std::string prefix = "inprocess." + robot.name + ".";
  std::vector<ReportRow> rows{row(prefix + "realtime_factor", "x", seconds / (processor_s() - began_s))};
  stack.expect(MotionPhase::kWalking);
  const auto add = [&](const std::string& name, double us) {
    rows.push_back(row(prefix + name, "us", us));
    rows.push_back(row(prefix + name + "_ratio", "-", us / reference_us));
  };
  double cores_us = 0.0;
  for (int part = 0; part < kPartCount; ++part) {
    const double us = stack.median_us(static_cast<Part>(part));
    add(std::string(kPartNames[part]) + "_cycle", us);
    if (part >= kEstimator) cores_us += us;
  }
  const double two_feet_us = distribution_us(robot, true);
  add("force_distribution_two_feet", two_feet_us);
  add("force_distribution_four_feet", distribution_us(robot, false));
  add("cores_cycle", cores_us - two_feet_us);
  const std::vector<double>& cycles_us = stack.cores_us();
  rows.push_back(
      row(prefix + "cores_processor_mean", "us",
          std::accumulate(cycles_us.begin(), cycles_us.end(), 0.0) / static_cast<double>(cycles_us.size())));
  rows.push_back(row(prefix + "cores_processor_p9999", "us", quantile(cycles_us, 0.9999)));
  rows.push_back(row(prefix + "simulation_over_mj_step", "-", bare_us / standing_us));
  rows.push_back(row(prefix + "stack_over_mj_step", "-", bare_us / standing_stack_us));
  return rows;
}

}  // namespace sprung
