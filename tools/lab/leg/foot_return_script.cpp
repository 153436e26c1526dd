#include "tools/lab/leg/foot_return_script.h"

#include <algorithm>
#include <cmath>

#include "signals/angles.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {
namespace {

using namespace foot_return;

/// Cycle that is `in_period_s` after the begin of that pull's period.
std::int64_t cycle_of(std::size_t pull, double in_period_s, double cycle_s) {
  return std::llround((kFirst_s + kPeriod_s * static_cast<double>(pull) + in_period_s) / cycle_s);
}

}  // namespace

std::vector<FootPull> eight_by_five(double first_force_N, double step_N) {
  std::vector<FootPull> out;
  for (int direction = 0; direction < 8; ++direction) {
    for (int force = 0; force < 5; ++force)
      out.push_back({0.25 * kPi * direction, first_force_N + step_N * force});
  }
  return out;
}

std::vector<FootReturnScript> runs_of(const FootReturnScript& script) {
  std::vector<FootReturnScript> out;
  for (std::size_t first = 0; first < script.pulls.size(); first += kPullsOfARun) {
    const std::size_t end = std::min(first + kPullsOfARun, script.pulls.size());
    out.push_back(script);
    out.back().pulls.assign(script.pulls.begin() + static_cast<std::ptrdiff_t>(first),
                            script.pulls.begin() + static_cast<std::ptrdiff_t>(end));
  }
  return out;
}

std::vector<OperatorCommand> orders(const FootReturnScript& run, double cycle_s) {
  std::vector<OperatorCommand> out{scripted(OperatorKind::kStand, std::llround(kStand_s / cycle_s))};
  for (std::size_t i = 0; i < run.pulls.size(); ++i) {
    if (i > 0) out.push_back(scripted(OperatorKind::kStop, cycle_of(i, 0.0, cycle_s)));
    OperatorCommand comply = scripted(OperatorKind::kComply, cycle_of(i, kCentre_s, cycle_s));
    comply.stiffness_N_m = {run.stiffness_N_m, 0.0, run.stiffness_N_m};
    comply.damping_N_s_m = {run.damping_N_s_m, 0.0, run.damping_N_s_m};
    comply.friction_compensation = run.friction_compensation;
    out.push_back(comply);
  }
  return out;
}

std::vector<SimControl> hand(const FootReturnScript& run, double cycle_s) {
  std::vector<SimControl> out;
  for (std::size_t i = 0; i < run.pulls.size(); ++i) {
    const FootPull& pull = run.pulls[i];
    SimControl control;
    control.kind = SimControlKind::kWrench;
    control.actuator = 0;  // the foot of this leg
    control.apply_at_seq = cycle_of(i, kPull_s, cycle_s);
    control.wrench = {pull.force_N * std::cos(pull.direction_rad), 0,
                      pull.force_N * std::sin(pull.direction_rad)};
    control.value = kGrow_s;
    control.duration_s = kGrow_s + kHold_s;
    out.push_back(control);
  }
  return out;
}

}  // namespace sprung
