#pragma once
/// A robot in a gait, in this process, for experiments that go on whatever becomes of it: a fall or a trip
/// ends nothing, it is noted.
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "signals/operator.h"
#include "signals/vec3.h"
#include "tools/lab/gait/legged_trial.h"
#include "tools/lab/gait/voltage_reserve.h"
#include "tools/lab/gait/walk_vitals.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

class WalkingRobot {
 public:
  using OnCycle = std::function<void(InProcessRobot& robot)>;

  /// Boots, homes and stands up as LeggedTrial; watched from then on. @throws as LeggedTrial, also where it
  /// cannot stand.
  WalkingRobot(const RobotConfig& robot, const std::string& preset, const SimOptions& sim);

  /// In that gait; what the command leaves open is the preset's. run() then throws where the planner refuses
  /// it: a robot that only stands would score well.
  void walk(const std::string& gait, const Vec3& speed, GaitControl control = GaitControl::kAdaptive);
  void say(const OperatorCommand& command) { trial_.say(command); }
  /// Impulse at the trunk's centre, evenly over `duration_s`; world axes.
  void push(const std::array<double, 2>& impulse_Ns, double duration_s);
  /// @throws std::runtime_error when the plant fails, or walk() was refused.
  void run(double duration_s, const OnCycle& on_cycle = {});

  const WalkVitals& vitals() const noexcept { return vitals_.result(); }
  /// Since run() was first called, while upright.
  const VoltageReserve& reserve() const noexcept { return reserve_.result(); }
  bool upright() const noexcept { return !vitals().fell && vitals().trips == 0; }
  InProcessRobot& robot() noexcept { return trial_.robot(); }
  double simulated_s() const noexcept { return trial_.simulated_s(); }
  int refusals() const noexcept { return refusals_; }
  const std::string& last_refusal() const noexcept { return last_refusal_; }

 private:
  const RobotConfig& config_;
  LeggedTrial trial_;
  VitalsWatch vitals_;
  VoltageReserveWatch reserve_;
  bool must_walk_ = false;
  int refusals_ = 0;
  std::string last_refusal_;
};

/// From standing until the body goes that fast in that gait, and two seconds more.
/// @param speed forward, left (m/s), turning (rad/s). @throws as gait_index().
double speed_reached_s(const RobotConfig& robot, const std::string& preset, const std::string& gait,
                       const Vec3& speed);

/// Those that go forward, or the one that is asked for. @throws std::invalid_argument for one that there is
/// not, or that goes nowhere.
std::vector<GaitConfig> going_gaits(const RobotConfig& robot, const std::string& asked);

/// One of a robot in a gait, but its own options and its run.
Experiment gait_experiment(const std::string& name, const std::string& what, const std::string& question);

}  // namespace sprung
