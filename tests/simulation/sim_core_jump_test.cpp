// A jump of the plant as in the trials.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/simulation/node/test_master.h"

namespace sprung::sim {
namespace {

constexpr double kCoreJumpCountsPerRad = 131072.0 * 100.0 / 6.283185307179586;

/// Both drives in position mode with the foot `length_m` under the hip: S0 (11), (12), knee behind.
void hold_length(SimMaster& master, double length_m) {
  constexpr double kThigh_m = 0.260;
  constexpr double kShank_m = 0.422;
  const double square = length_m * length_m - kShank_m * kShank_m;
  const double knee_rad = std::acos((square - kThigh_m * kThigh_m) / (2 * kThigh_m * kShank_m));
  const double hip_rad = M_PI / 2 + std::acos((square + kThigh_m * kThigh_m) / (2 * kThigh_m * length_m));
  const auto counts = [](double rad) {
    return static_cast<std::int32_t>(std::lround(rad * kCoreJumpCountsPerRad));
  };
  master.drive(1, {{1, {0, counts(hip_rad), 8}}, {2, {0, counts(knee_rad), 8}}});
}

/// Leg length of facts C2's jump, control points raised to degree 6.
double jump_length_m(double time_s) {
  constexpr double kDuration_s = 0.2;
  std::vector<double> points = {0.3500, 0.4028, 0.4258, 0.5060, 0.6340, 0.4905, 0.4780};
  const double share = std::min(time_s / kDuration_s, 1.0);
  for (std::size_t left = points.size() - 1; left > 0; --left) {
    for (std::size_t i = 0; i < left; ++i) points[i] += share * (points[i + 1] - points[i]);
  }
  return points[0];
}

struct Jump {
  double height_m = 0.0;  ///< rise of the base since the foot left the ground
  int touchdown_ms = 0;
  double hip_output_Nm = 0.0;  ///< gear, push-off
  double knee_output_Nm = 0.0;
};

Jump jump(SimMaster& master) {
  Jump result;
  double take_off_m = 0.0;
  for (int ms = 1; ms <= 800 && result.touchdown_ms == 0; ++ms) {
    hold_length(master, jump_length_m(1e-3 * ms));
    const SimTruth& truth = master.sim.truth();
    const bool in_air = truth.legs[0].true_foot_in_world_m[2] > 0.02;  // its radius
    if (ms < 200 && !in_air) take_off_m = truth.base_in_world_m[2];
    if (ms > 200 && !in_air) result.touchdown_ms = ms;
    result.height_m = std::max(result.height_m, truth.base_in_world_m[2] - take_off_m);
    if (ms > 150) continue;
    const double hip_Nm = std::abs(truth.joints[0].true_gear_output_torque_Nm);
    const double knee_Nm = std::abs(truth.joints[1].true_gear_output_torque_Nm);
    result.hip_output_Nm = std::max(result.hip_output_Nm, hip_Nm);
    result.knee_output_Nm = std::max(result.knee_output_Nm, knee_Nm);
  }
  return result;
}

/// In position mode, by hand: plant and drives must give what the trials with the same parameters gave.
TEST(SimCoreJump, PlantJ3JumpsAsInTheTrials) {
  SimMaster master;
  master.boot();
  hold_length(master, 0.300);
  master.enable();
  for (int i = 0; i < 1000; ++i) hold_length(master, 0.300 + 0.00005 * i);
  for (int i = 0; i < 500; ++i) hold_length(master, 0.350);
  const Jump result = jump(master);
  EXPECT_FALSE(master.sim.failed());
  EXPECT_NEAR(result.height_m, 0.187, 0.0187);  // facts physics 12: 186.9 mm, 552.8 ms
  EXPECT_NEAR(result.touchdown_ms, 553, 10);
  EXPECT_NEAR(result.hip_output_Nm, 24.0, 4.0);  // errata E8
  EXPECT_NEAR(result.knee_output_Nm, 33.0, 4.0);
}

}  // namespace
}  // namespace sprung::sim
