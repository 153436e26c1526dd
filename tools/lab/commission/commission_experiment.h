#pragma once
/// `sprung experiment commission`: drives with drawn mistakes of wiring and setting, and as many right ones,
/// each walked through by `sprung drive commission`: is every mistake found, at which step, and how much
/// torque and motion was there until then?
#include <string>
#include <vector>

#include "tools/can/commission/protocol.h"
#include "tools/lab/commission/mistakes.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

struct CommissionOutcome {
  std::string robot, drive;
  Mistake mistake = Mistake::kNone;
  std::string detail{};
  std::string found_at{};     ///< step; "" = not found
  double torque_share = 0.0;  ///< highest true torque until then, of the joint's true breakaway friction
  double motion_rad = 0.0;    ///< true, under torque
  double simulated_s = 0.0;
  commission::Protocol protocol{};

  bool right() const;  ///< found where there is one, none where there is none
};

/// Bounds of the table: issue 21.
inline constexpr double kTorqueShare = 1.5, kMotion_rad = 0.05;

/// @param true_breakaway_Nm of the joint, for the share.
CommissionOutcome run_commission_case(const CommissionCase& drawn);

/// `count` drawn mistakes, every kind once before any twice, on the robots in turn; then as many right
/// drives.
std::vector<CommissionOutcome> run_commission_cases(const std::vector<RobotConfig>& robots,
                                                    std::uint64_t seed, int count,
                                                    const ParallelOptions& parallel);

Experiment commission_experiment();

}  // namespace sprung
