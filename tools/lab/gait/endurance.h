#pragma once
/// `sprung experiment endurance`: minutes of an operator's commands at random on drawn plants, on a flat
/// floor or in drawn worlds: who falls, what trips.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/operator.h"
#include "simulation/sim_core.h"
#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/gait/voltage_reserve.h"
#include "tools/lab/gait/walk_vitals.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

/// One request, and how long it stands.
struct EnduranceStep {
  OperatorCommand command;  ///< kWalk or kStop
  double lasts_s = 0.0;
};

/// Requests of 3 to 12 s each, `duration_s` in all: gaits that may follow each other, speeds and turning over
/// all that a gait allows, body heights and stance widths; one in eight stops. Every one is allowed where it
/// stands. The same seed gives the same.
/// @param duration_s at least 0.
std::vector<EnduranceStep> endurance_script(const RobotConfig& robot, const std::string& preset,
                                            std::uint64_t seed, double duration_s);

/// The changes of one plant: friction within 20 %, mass within 10 %, floor friction of 0.4 to 1.0, drawn
/// evenly.
std::map<std::string, double> endurance_plant(std::uint64_t number);

struct EnduranceRequest {
  std::string preset;      ///< empty = the robot's usual one
  std::uint64_t seed = 1;  ///< the first
  int seeds = 20;
  double minutes = 10.0;                ///< of each
  std::map<std::string, double> plant;  ///< changes over what is drawn
  ParallelOptions parallel;
  std::uint64_t
      ensemble = 1;     ///< of plants: those of another seed are the same, with other noise and requests
  bool worlds = false;  ///< each in a world of its own: endurance_world.h
};

struct EnduranceOutcome {
  std::uint64_t seed = 0;
  std::map<std::string, double> plant;
  WalkVitals vitals;
  VoltageReserve reserve{};  ///< from the first request on
  std::string doing;         ///< when it fell or tripped first: the request; empty: it never did
  int requests = 0;
  int refusals = 0;
  double simulated_s = 0.0;
  double processor_s = 0.0;  ///< of one core
};

/// One of the seeds, in this process; ends a second after a fall or trip.
EnduranceOutcome endure(const RobotConfig& robot, const EnduranceRequest& request, std::size_t place);

/// @throws CaseError where a simulation fails, std::invalid_argument for what cannot be asked.
std::vector<EnduranceOutcome> run_endurance(const RobotConfig& robot, const EnduranceRequest& request);

/// Rows endurance.all.*, or endurance.worlds.*, of which one fall is borne if it is noticed: pure, the same
/// bits whatever the machine does.
std::vector<ReportRow> endurance_rows(const std::vector<EnduranceOutcome>& outcomes, bool worlds = false);
report::Section endurance_section(const std::vector<EnduranceOutcome>& outcomes);
/// Simulated time over a core's time: a measurement of this machine, and so no row. NaN where nothing was
/// measured.
double endurance_speed(const std::vector<EnduranceOutcome>& outcomes) noexcept;

Experiment endurance_experiment();

}  // namespace sprung
