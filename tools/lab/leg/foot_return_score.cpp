#include "tools/lab/leg/foot_return_score.h"

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

namespace {

using namespace foot_return;

double along(const PlanePoint& p, double direction_rad) noexcept {
  return p.x_m * std::cos(direction_rad) + p.z_m * std::sin(direction_rad);
}

double distance_m(const PlanePoint& a, const PlanePoint& b) noexcept {
  return std::hypot(a.x_m - b.x_m, a.z_m - b.z_m);
}

/// Lowest and highest value so far.
struct Range {
  double low = kNaN, high = kNaN;
  void add(double value) noexcept {
    low = std::fmin(low, value);
    high = std::fmax(high, value);
  }
  double width() const noexcept { return high - low; }
};

/// Last sample before `time_s`; the first where there is none.
std::size_t index_before(const PullTrace& trace, double time_s) {
  const auto at = std::lower_bound(trace.time_s.begin(), trace.time_s.end(), time_s - 1e-6);
  return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, at - trace.time_s.begin() - 1));
}

}  // namespace

bool PullResult::limit_cycle() const noexcept { return swing_mm > kSwing_mm || swing_Nm > kSwing_Nm; }

void FootReturnScorer::add(double time_s, const PlanePoint& foot_m,
                           const std::array<double, 2>& commanded_Nm) {
  if (time_s < kFirst_s) return;
  const auto pull = static_cast<std::size_t>((time_s - kFirst_s) / kPeriod_s + 1e-6);
  if (pull >= script_.pulls.size()) return;
  const double in_period_s = time_s - kFirst_s - kPeriod_s * static_cast<double>(pull);
  if (in_period_s < kCentre_s) return;
  traces_.resize(pull + 1);
  traces_[pull].time_s.push_back(in_period_s - kRelease_s);
  traces_[pull].foot_m.push_back(foot_m);
  traces_[pull].commanded_Nm.push_back(commanded_Nm);
}

std::vector<PullResult> FootReturnScorer::results() const {
  std::vector<PullResult> out;
  for (std::size_t i = 0; i < traces_.size(); ++i) out.push_back(pull_result(script_.pulls[i], traces_[i]));
  return out;
}

PullResult pull_result(const FootPull& pull, const PullTrace& trace) {
  PullResult out;
  out.pull = pull;
  if (trace.foot_m.empty()) return out;
  const PlanePoint before_m = trace.foot_m[index_before(trace, kPull_s - kRelease_s)];
  out.held_m = trace.foot_m[index_before(trace, 0.0)];
  out.back_m = trace.foot_m.back();
  out.moved_mm = 1e3 * (along(out.held_m, pull.direction_rad) - along(before_m, pull.direction_rad));
  out.error_mm = 1e3 * distance_m(out.back_m, {});
  Range x, z, torque[2];
  for (std::size_t k = 0; k < trace.time_s.size(); ++k) {
    const double time_s = trace.time_s[k];
    if (time_s > 0.0 && 1e3 * distance_m(trace.foot_m[k], out.back_m) > PullResult::kSettled_mm)
      out.settled_s = time_s;
    if (time_s < PullResult::kSettle_s) continue;
    x.add(trace.foot_m[k].x_m);
    z.add(trace.foot_m[k].z_m);
    for (std::size_t j = 0; j < 2; ++j) torque[j].add(trace.commanded_Nm[k][j]);
  }
  out.swing_mm = 1e3 * std::max(x.width(), z.width());
  out.swing_Nm = std::max(torque[0].width(), torque[1].width());
  return out;
}

double measured_stiffness_N_m(const std::vector<PullResult>& pulls, double direction_rad) {
  double n = 0, force = 0, way = 0, force_way = 0, way_way = 0;
  for (const PullResult& p : pulls) {
    if (p.pull.direction_rad != direction_rad) continue;
    const double d_m = along(p.held_m, direction_rad);
    n += 1;
    force += p.pull.force_N;
    way += d_m;
    force_way += p.pull.force_N * d_m;
    way_way += d_m * d_m;
  }
  const double spread = way_way - way * way / n;
  return n >= 2 && spread > 0.0 ? (force_way - force * way / n) / spread : kNaN;
}

FootReturnSummary summarize(const std::vector<PullResult>& pulls) {
  Range error, moved, settled, stiffness;
  FootReturnSummary out;
  double sum_mm = 0.0;
  for (const PullResult& p : pulls) {
    error.add(p.error_mm);
    moved.add(p.moved_mm);
    settled.add(p.settled_s);
    stiffness.add(measured_stiffness_N_m(pulls, p.pull.direction_rad));
    sum_mm += p.error_mm;
    out.limit_cycles += p.limit_cycle() ? 1 : 0;
  }
  out.mean_mm = sum_mm / static_cast<double>(pulls.size());
  out.max_mm = error.high;
  out.min_mm = error.low;
  out.moved_least_mm = moved.low;
  out.settled_worst_s = settled.high;
  out.stiffness_least_N_m = stiffness.low;
  out.stiffness_most_N_m = stiffness.high;
  return out;
}

}  // namespace sprung
