#pragma once
/// What the gaits' motors have left in other directions than ahead, and in curves: of `sprung experiment
/// walk`.
#include <string>
#include <vector>

#include "signals/vec3.h"
#include "simulation/sim_core.h"
#include "tools/common/report/report.h"
#include "tools/lab/gait/voltage_reserve.h"
#include "tools/lab/gait/walk_vitals.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct Manoeuvre {
  std::string gait;
  std::string direction;  ///< "forward", "backward", "sideways", "turning", "curve"
  Vec3 speed{};           ///< forward, left (m/s), turning (rad/s)
};

struct ManoeuvreOutcome {
  Manoeuvre what;
  WalkVitals vitals;
  VoltageReserve reserve;  ///< from the first step on
  double simulated_s = 0.0;
};

/// Every gait that goes, at its fastest forward, backward, to the left, on the spot, and in a curve of all
/// three, each at 1 / sqrt 3 of its fastest.
std::vector<Manoeuvre> manoeuvres(const RobotConfig& robot);

/// Until the speed is reached, and three periods more.
ManoeuvreOutcome manoeuvre(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                           const Manoeuvre& what);

/// walk.GAIT.DIRECTION.voltage_reserve and .stays_up.
std::vector<ReportRow> manoeuvre_rows(const std::vector<ManoeuvreOutcome>& outcomes);
report::Section manoeuvre_section(const std::vector<ManoeuvreOutcome>& outcomes);

}  // namespace sprung
