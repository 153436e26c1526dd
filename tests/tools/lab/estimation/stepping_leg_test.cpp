#include "tools/lab/estimation/stepping_leg.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace sprung {
namespace {

/// A leg that follows its command exactly and meets the floor of each step.
struct PerfectLeg {
  int steps = 0;
  int touchdowns = 0;
  double fastest_m_s = 0.0;
  double lowest_m = 0.0;
  std::set<double> floors_m;

  explicit PerfectLeg(const SteppingScript& script) {
    SteppingLeg stepping(script);
    JointState in(2, 1);
    LegCommand out(1);
    in.legs[0].estimated_foot_in_hip_m = {0.0, 0.0, -0.30};
    double floor_m = -1.0;
    for (int k = 0; k < 1'000'000 && !stepping.done(); ++k) {
      in.stamp = {1000 * k, k};
      for (EstimatedJoint& joint : in.joints) {
        joint.drive_enabled = k > 10;
        joint.status = k > 20 ? JointStatus::kOk : JointStatus::kStarting;
      }
      const bool touched = script.hip_height_m + in.legs[0].estimated_foot_in_hip_m[2] < floor_m;
      touchdowns += touched && !in.legs[0].contact ? 1 : 0;
      in.legs[0].contact = touched;
      stepping.command(in, out);
      if (stepping.step_begins()) {
        ++steps;
        floors_m.insert(floor_m = stepping.floor_height_m());
      }
      const DesiredLeg& leg = out.legs[0];
      fastest_m_s = std::max(fastest_m_s, -leg.desired_foot_velocity_m_s[2]);
      lowest_m = std::max(lowest_m, -leg.desired_foot_in_hip_m[2]);
      in.legs[0].estimated_foot_in_hip_m = leg.desired_foot_in_hip_m;
    }
  }
};

SteppingScript script(std::uint64_t seed, int steps) {
  SteppingScript s;
  s.seed = seed;
  s.steps = steps;
  return s;
}

TEST(SteppingLegTest, TakesItsStepsOntoAFloorThatMoves) {
  const PerfectLeg run(script(3, 60));
  EXPECT_EQ(run.steps, 60);
  EXPECT_GT(run.floors_m.size(), 40u);
  EXPECT_LE(*run.floors_m.rbegin(), 0.03);
  EXPECT_EQ(*run.floors_m.begin(), -1.0);  // none
  EXPECT_GE(*std::next(run.floors_m.begin()), -0.03);
  EXPECT_GT(run.touchdowns, 40);
  EXPECT_LT(run.touchdowns, 60);
  EXPECT_GT(run.fastest_m_s, 1.1);
}

TEST(SteppingLegTest, WithoutAFloorItEndsAtItsLowestPoint) {
  SteppingScript none = script(4, 10);
  none.share_without_floor = 1.1;
  const PerfectLeg run(none);
  EXPECT_EQ(run.touchdowns, 0);
  EXPECT_EQ(run.steps, 10);
  EXPECT_NEAR(run.lowest_m, none.lowest_m, 0.003);
}

TEST(SteppingLegTest, SeedsDifferAndRepeat) {
  EXPECT_EQ(PerfectLeg(script(5, 10)).floors_m, PerfectLeg(script(5, 10)).floors_m);
  EXPECT_NE(PerfectLeg(script(5, 10)).floors_m, PerfectLeg(script(6, 10)).floors_m);
}

TEST(SteppingLegTest, WaitsForTheDrives) {
  SteppingLeg stepping(script(1, 1));
  JointState in(2, 1);
  LegCommand out(1);
  in.legs[0].estimated_foot_in_hip_m = {0.01, 0.0, -0.30};
  for (int k = 0; k < 3000; ++k) {
    in.stamp = {1000 * k, k};
    stepping.command(in, out);
  }
  EXPECT_EQ(out.legs[0].desired_foot_in_hip_m, in.legs[0].estimated_foot_in_hip_m);
  EXPECT_FALSE(stepping.done());
}

}  // namespace
}  // namespace sprung
