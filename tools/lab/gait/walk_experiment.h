#pragma once
/// `sprung experiment walk`: feet in swing and touchdowns in each kind of control (S1, Figs. 12 and 13), and
/// how straight and fast the gaits go.
#include <vector>

#include "signals/vec3.h"
#include "simulation/sim_core.h"
#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/gait/manoeuvres.h"
#include "tools/lab/gait/step_score.h"
#include "tools/lab/gait/transport_cost.h"
#include "tools/lab/gait/voltage_reserve.h"
#include "tools/lab/gait/walk_vitals.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct WalkTask {
  std::string preset;  ///< empty = the robot's usual one
  SimOptions sim;
  double distance_m = 10.0;  ///< that speed and drift are taken over
  ParallelOptions parallel;
};

/// One foot through its swings, for plots: world axes would hide the tracking, so hip axes.
struct FootTrace {
  std::vector<double> time_s, wanted_x_m, wanted_z_m, foot_x_m, foot_z_m, force_N;
};

struct WalkControl {
  GaitControl control = GaitControl::kForce;
  bool feeds_inertia = true;  ///< as the preset's swing_compensation says; false: S1's springs, which have
                              ///< none
};

struct ControlOutcome {
  WalkControl control{};
  double swing_rms_m = kNaN;
  TouchdownPeaks peaks;
  int touchdowns = 0;
  WalkVitals vitals;
  FootTrace trace;  ///< of the left front leg
  double simulated_s = 0.0;
};

struct GaitCase {
  std::string name;  ///< of rows
  std::string gait;
  double speed_m_s = 0.0;
  bool demanded = true;  ///< false: a stretch, of whose rows the voltage reserve alone has a bound
};

struct GaitOutcome {
  GaitCase config;
  double speed_m_s = kNaN, drift_rad = kNaN, distance_m = 0.0;
  WalkVitals vitals;
  double simulated_s = 0.0;
  VoltageReserve reserve;  ///< from the first step on
  /// Of the estimated from the true trunk's velocity, trunk axes: rms, and how much it is faster ahead on the
  /// mean, share of the true.
  double velocity_rms_m_s = kNaN, velocity_off = kNaN;
  double power_W = kNaN, transport_cost = kNaN;  ///< transport_cost.h
};

/// What the rows of one robot are held against.
struct WalkLimits {
  double compared_m_s = kNaN;  ///< speed of the controls' gait
  double speed_rad_s = 0.0;    ///< of the joints: robot.yaml's speed cap, the highest
  double torque_Nm = 0.0;      ///< of the motors: a share of robot.yaml's limit, the lowest
};
/// @throws as gait_cases().
WalkLimits walk_limits(const RobotConfig& robot);

struct WalkExperiment {
  WalkLimits limits;
  std::vector<ControlOutcome> controls;
  std::vector<GaitOutcome> gaits;
  std::vector<ManoeuvreOutcome> manoeuvres;
  double simulated_s = 0.0;
};

/// crawl, walk and trot at their usual shares of the fastest speeds in robot.yaml, and as a stretch a faster
/// trot. Pegasus: 0.1, 0.2, 0.35 and 0.4 m/s. @throws std::invalid_argument where the robot has not these
/// gaits.
std::vector<GaitCase> gait_cases(const RobotConfig& robot);

/// In gait `walk` at the speed of its case: nine seconds after two of starting.
ControlOutcome walk_under(RobotConfig robot, const WalkTask& request, const WalkControl& control);
/// Measured from when the speed is reached. Given up after a fall, or in twice the time that it should take.
GaitOutcome go(const RobotConfig& robot, const WalkTask& request, const GaitCase& config);

/// @throws CaseError where a simulation fails.
WalkExperiment run_walk_experiment(const RobotConfig& robot, const WalkTask& request);
/// Rows walk.*, with issue 6's bounds: pure.
std::vector<ReportRow> walk_rows(const WalkExperiment& result);
std::vector<report::Section> walk_sections(const WalkExperiment& result);

Experiment walk_experiment();

}  // namespace sprung
