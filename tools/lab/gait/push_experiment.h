#pragma once
/// `sprung experiment push`: impulses at the trunk's centre while the robot holds its stance in position
/// control, stands on its springs, or trots; up to what is survived by every push, and whether a fall beyond
/// that is caught.
#include <array>
#include <string>
#include <vector>

#include "signals/enumeration.h"
#include "simulation/sim_core.h"
#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/gait/walk_vitals.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct PushCase {
  std::string name;  ///< of rows: held, stand, trot
  std::string gait;  ///< empty: none, the legs hold their stance in position control
  double speed_m_s = 0.0;
  int phases = 1;                   ///< of the gait's period, at which a push begins; evenly spread
  std::vector<double> impulses_Ns;  ///< ascending
  double demanded_Ns = 0.0;         ///< sideways; 0: nothing is demanded
};

enum class PushDirection { kLeft, kRight, kForward, kBackward };
constexpr auto words_of(PushDirection) {
  return words<PushDirection>({
      {PushDirection::kLeft, "left"},
      {PushDirection::kRight, "right"},
      {PushDirection::kForward, "forward"},
      {PushDirection::kBackward, "backward"},
  });
}

/// World axes.
std::array<double, 2> impulse_vector_Ns(PushDirection direction, double impulse_Ns) noexcept;

struct PushOutcome {
  std::string name;
  double impulse_Ns = 0.0;
  PushDirection direction = PushDirection::kLeft;
  int survived = 0;  ///< pushes, of the case's phases, one after the other on the same robot
  double tilt_most_rad = 0.0;
  double capture_beyond = kNaN;  ///< capture_beyond(), largest
  WalkVitals vitals;
  double reserve = kNaN;  ///< VoltageReserve, least
  double simulated_s = 0.0;

  bool stayed_up() const noexcept { return !vitals.fell && vitals.trips == 0; }
};

struct PushTask {
  std::string preset;  ///< empty = the robot's usual one
  SimOptions sim;
  ParallelOptions parallel;
};

/// As issue 6 asks: standing 30 N s, trotting 15 N s, a held stance beside them; and well beyond.
std::vector<PushCase> push_cases();

/// Over 0.1 s, in world axes; 2.5 s for each to recover.
PushOutcome push_once(const RobotConfig& robot, const PushTask& task, const PushCase& config,
                      double impulse_Ns, PushDirection direction);

/// Of each case, impulse and direction. @throws CaseError where a simulation fails.
std::vector<PushOutcome> run_push(const RobotConfig& robot, const PushTask& task,
                                  const std::vector<PushCase>& cases);

/// The largest up to which this case stayed up, whatever the phase and side; 0: it never did. Pure.
double survived_impulse_Ns(const PushCase& config, const std::vector<PushOutcome>& outcomes, bool sideways);
/// Rows push.*: pure.
std::vector<ReportRow> push_rows(const std::vector<PushCase>& cases,
                                 const std::vector<PushOutcome>& outcomes);
report::Section push_section(const std::vector<PushOutcome>& outcomes);

Experiment push_experiment();

}  // namespace sprung
