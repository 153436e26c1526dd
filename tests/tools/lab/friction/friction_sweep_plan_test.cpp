#include "tools/lab/friction/friction_sweep_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "tests/support/enumerators.h"
#include "tools/lab/friction/friction_sweep_bench.h"

namespace sprung {
namespace {

const BenchLimits kFrictionSweepPlanKnee{0.07, 2.53, 4.36, 133.0, 23.0};

constexpr SweepProtocol kAll[] = {SweepProtocol::kS0, SweepProtocol::kS1, SweepProtocol::kLoaded};

TEST(FrictionSweepPlan, EveryPassStaysWithinTheJointAndReachesItsSpeed) {
  for (const SweepProtocol protocol : kAll) {
    const SweepPlan plan = sweep_plan(protocol, kFrictionSweepPlanKnee);
    for (const SweepPass& pass : plan.passes) {
      EXPECT_GE(std::min(pass.from_rad, pass.to_rad), kFrictionSweepPlanKnee.position_min_rad - 1e-9)
          << name(protocol);
      EXPECT_LE(std::max(pass.from_rad, pass.to_rad), kFrictionSweepPlanKnee.position_max_rad + 1e-9)
          << name(protocol);
      EXPECT_LE(pass.speed_rad_s, kFrictionSweepPlanKnee.speed_rad_s);
      const SteadySpan span = steady_span(pass, plan.mirrored);
      EXPECT_GT(span.to_s - span.from_s, 0.1) << name(protocol) << " at " << pass.speed_rad_s;
      EXPECT_GT(span.from_s, pass.speed_rad_s / pass.acceleration_rad_s2);
    }
  }
}

TEST(FrictionSweepPlan, ThereAndBackAlternateOverTheSameWay) {
  for (const SweepProtocol protocol : kAll) {
    const SweepPlan plan = sweep_plan(protocol, kFrictionSweepPlanKnee);
    ASSERT_EQ(plan.passes.size() % 2, 0u);
    for (std::size_t i = 0; i < plan.passes.size(); i += 2) {
      EXPECT_EQ(plan.passes[i].direction(), 1.0);
      EXPECT_EQ(plan.passes[i + 1].direction(), -1.0);
      EXPECT_EQ(plan.passes[i].from_rad, plan.passes[i + 1].to_rad);
      EXPECT_EQ(plan.passes[i].speed_rad_s, plan.passes[i + 1].speed_rad_s);
      EXPECT_EQ(plan.passes[i].held_out, plan.passes[i + 1].held_out);
    }
  }
}

TEST(FrictionSweepPlan, S1SpeedsAreUniformFromTwoHundredthsToFour) {
  const SweepPlan plan = sweep_plan(SweepProtocol::kS1, kFrictionSweepPlanKnee);
  std::set<double> speeds;
  for (const SweepPass& pass : plan.passes) speeds.insert(pass.speed_rad_s);
  EXPECT_DOUBLE_EQ(*speeds.begin(), 0.02);
  EXPECT_DOUBLE_EQ(*speeds.rbegin(), 4.0);
  const double step = (4.0 - 0.02) / static_cast<double>(speeds.size() - 1);
  double expected = 0.02;
  for (const double speed : speeds) {
    EXPECT_NEAR(speed, expected, 1e-12);
    expected += step;
  }
}

TEST(FrictionSweepPlan, LoadedPassesMeetEveryLoadAtEverySpeedAndHoldOutHalf) {
  const SweepPlan plan = sweep_plan(SweepProtocol::kLoaded, kFrictionSweepPlanKnee);
  std::set<double> loads, speeds, held_loads, held_speeds;
  std::size_t held = 0;
  double sum_Nm = 0.0;
  for (const SweepPass& pass : plan.passes) {
    loads.insert(pass.load_Nm);
    speeds.insert(pass.speed_rad_s);
    sum_Nm += pass.load_Nm;
    if (!pass.held_out) continue;
    ++held;
    held_loads.insert(pass.load_Nm);
    held_speeds.insert(pass.speed_rad_s);
  }
  EXPECT_EQ(plan.passes.size(), 2 * loads.size() * speeds.size());
  EXPECT_EQ(2 * held, plan.passes.size());
  EXPECT_EQ(held_loads, loads);
  EXPECT_EQ(held_speeds, speeds);
  EXPECT_NEAR(sum_Nm, 0.0, 1e-9);
  EXPECT_LT(*loads.rbegin(), kFrictionSweepPlanKnee.rated_torque_Nm);
}

TEST(FrictionSweepPlan, MirroredSpansSeeTheSameAnglesThereAndBack) {
  const SweepPlan plan = sweep_plan(SweepProtocol::kS0, kFrictionSweepPlanKnee);
  for (const SweepPass& pass : plan.passes) {
    const SteadySpan span = steady_span(pass, true);
    const double whole_s = std::abs(pass.to_rad - pass.from_rad) / pass.speed_rad_s +
                           pass.speed_rad_s / pass.acceleration_rad_s2;
    EXPECT_NEAR(span.from_s, whole_s - span.to_s, 1e-9) << pass.speed_rad_s;
  }
}

TEST(FrictionSweepPlan, AJointThatIsTooShortOrTooSlowIsRefused) {
  BenchLimits abduction = kFrictionSweepPlanKnee;
  abduction.position_min_rad = -0.3;
  abduction.position_max_rad = 0.3;
  EXPECT_THROW((void)sweep_plan(SweepProtocol::kS1, abduction), std::invalid_argument);
  BenchLimits slow = kFrictionSweepPlanKnee;
  slow.speed_rad_s = 2.0;
  EXPECT_THROW((void)sweep_plan(SweepProtocol::kS0, slow), std::invalid_argument);
}

TEST(FrictionSweepPlan, EveryProtocolHasItsOwnName) { test::expect_own_names<SweepProtocol>(); }

TEST(FrictionSweepPlan, SamplesArePickedEvenlyAndNeverTwice) {
  EXPECT_EQ(evenly_picked(10, 5), (std::vector<std::size_t>{0, 2, 4, 6, 8}));
  EXPECT_EQ(evenly_picked(3, 5), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(evenly_picked(0, 5).empty());
}

}  // namespace
}  // namespace sprung
