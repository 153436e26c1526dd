#include "tools/lab/friction/friction_sweep_plan.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tools/lab/friction/friction_sweep_bench.h"

namespace sprung {
namespace {

/// The position loops (robot.yaml: 4 to 6.5 Hz, damping ratio 0.6 to 0.75) are within 1 % after this long.
constexpr double kSettleSpeed_s = 0.25;
constexpr double kSteadyLeast_s = 0.15;
/// From a command to the first cycle that follows it, with room.
constexpr double kAnswer_s = 0.01;
/// Gentle, so that little is left of the start when the loop has settled.
constexpr double kSweepAcceleration_rad_s2 = 25.0;
/// Slow passes: as long as it takes for a few turns of the motor, no longer.
constexpr double kShortest_rad = 0.15;
constexpr double kLongest_s = 2.0;

constexpr double kS1Slowest_rad_s = 0.02;  // facts papers C4
constexpr double kS1Fastest_rad_s = 4.0;
constexpr int kS1Speeds = 40;
constexpr int kS0Repeats = 3;         // S0 section II-A: "several speeds and repeats"
constexpr double kLoadOfRated = 0.8;  // beyond it the motor would get too warm

struct Settings {
  std::vector<double> speeds_rad_s;
  std::vector<double> loads_Nm;
  int repeats = 1;
  std::size_t samples = 0;
  bool mirrored = false;
};

Settings settings(SweepProtocol protocol, const BenchLimits& limits) {
  Settings out;
  switch (protocol) {
    case SweepProtocol::kS0:
      return {{0.1, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0}, {0.0}, kS0Repeats, 60, true};
    case SweepProtocol::kS1:
      for (int i = 0; i < kS1Speeds; ++i)
        out.speeds_rad_s.push_back(kS1Slowest_rad_s +
                                   (kS1Fastest_rad_s - kS1Slowest_rad_s) * i / (kS1Speeds - 1));
      out.loads_Nm = {0.0};
      out.samples = 60;
      return out;
    case SweepProtocol::kLoaded: {
      const double most_Nm = kLoadOfRated * limits.rated_torque_Nm;
      return {
          {0.05, 0.15, 0.4, 1.0, 2.0, 3.0}, {0.0, most_Nm / 2, most_Nm, -most_Nm / 2, -most_Nm}, 1, 60, true};
    }
  }
  return out;
}

double ramps_rad(const SweepPass& pass) {
  return pass.speed_rad_s * pass.speed_rad_s / pass.acceleration_rad_s2;
}

/// Half the way of a pass around the middle of the range.
double half_way_rad(const SweepPass& pass, bool mirrored, const BenchLimits& limits) {
  const double range_rad = limits.position_max_rad - limits.position_min_rad;
  const double steady_s = (mirrored ? 2.0 : 1.0) * kSettleSpeed_s + kSteadyLeast_s;
  const double least_rad = ramps_rad(pass) + pass.speed_rad_s * steady_s;
  if (least_rad > range_rad || pass.speed_rad_s > limits.speed_rad_s)
    throw std::invalid_argument("a constant speed of " + std::to_string(pass.speed_rad_s) +
                                " rad/s needs more range or speed than this joint has");
  const double wanted_rad = std::max({kShortest_rad, least_rad, kLongest_s * pass.speed_rad_s});
  return 0.5 * std::min(range_rad, wanted_rad);
}

/// There and back.
void add_passes(SweepPass pass, bool mirrored, const BenchLimits& limits, std::vector<SweepPass>& out) {
  pass.acceleration_rad_s2 = std::min(kSweepAcceleration_rad_s2, 0.5 * limits.acceleration_rad_s2);
  const double half_rad = half_way_rad(pass, mirrored, limits);
  const double middle_rad = 0.5 * (limits.position_min_rad + limits.position_max_rad);
  pass.from_rad = middle_rad - half_rad;
  pass.to_rad = middle_rad + half_rad;
  out.push_back(pass);
  std::swap(pass.from_rad, pass.to_rad);
  out.push_back(pass);
}

}  // namespace

SweepPlan sweep_plan(SweepProtocol protocol, const BenchLimits& limits) {
  const Settings s = settings(protocol, limits);
  SweepPlan plan;
  plan.samples_a_pass = s.samples;
  plan.mirrored = s.mirrored;
  for (std::size_t l = 0; l < s.loads_Nm.size(); ++l) {
    for (int repeat = 0; repeat < s.repeats; ++repeat) {
      for (std::size_t v = 0; v < s.speeds_rad_s.size(); ++v) {
        SweepPass pass;
        pass.speed_rad_s = s.speeds_rad_s[v];
        pass.load_Nm = s.loads_Nm[l];
        pass.held_out = (l + v) % 2 == 1;
        add_passes(pass, s.mirrored, limits, plan.passes);
      }
    }
  }
  return plan;
}

SteadySpan steady_span(const SweepPass& pass, bool mirrored) {
  const double rising_s = pass.speed_rad_s / pass.acceleration_rad_s2;
  const double way_rad = std::abs(pass.to_rad - pass.from_rad);
  const double steady_s = (way_rad - ramps_rad(pass)) / pass.speed_rad_s;
  return {rising_s + kSettleSpeed_s, rising_s + steady_s - (mirrored ? kSettleSpeed_s : kAnswer_s)};
}

std::vector<std::size_t> evenly_picked(std::size_t count, std::size_t wanted) {
  std::vector<std::size_t> out;
  const std::size_t picked = std::min(count, wanted);
  for (std::size_t i = 0; i < picked; ++i) out.push_back(i * count / picked);
  return out;
}

}  // namespace sprung
