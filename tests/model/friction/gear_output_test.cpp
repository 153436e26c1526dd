#include "model/friction/gear_output.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/model/friction/friction_examples.h"
#include "tests/model/friction/parameter_sets.h"

namespace sprung {
namespace {

FrictionParameters loaded() {
  FrictionParameters p;
  p.coulomb_Nm = 3.0;
  p.load_share_driving = 0.25;
  p.load_share_driven = 0.2;
  return p;
}

TEST(GearOutputTest, ClosedFormDrivingAndDriven) {
  EXPECT_DOUBLE_EQ(solve_gear_output(loaded(), 28.0, at(1.0)).torque_Nm, 20.0);    // 20 + 3 + 0.25 * 20
  EXPECT_DOUBLE_EQ(solve_gear_output(loaded(), -13.0, at(1.0)).torque_Nm, -20.0);  // -20 + 3 + 0.2 * 20
  EXPECT_DOUBLE_EQ(solve_gear_output(loaded(), -28.0, at(-1.0)).torque_Nm, -20.0);
  EXPECT_DOUBLE_EQ(solve_gear_output(loaded(), 13.0, at(-1.0)).torque_Nm, 20.0);
}

TEST(GearOutputTest, BalancesWithTheLawAtEveryPoint) {
  const FrictionParameters p = full_friction();
  for (FrictionInput in : many_points()) {
    const double load_Nm = in.gear_output_torque_Nm;
    const double available_Nm = load_Nm + friction_torque_Nm(p, in);
    const GearOutput out = solve_gear_output(p, available_Nm, in);
    EXPECT_NEAR(out.torque_Nm, load_Nm, 1e-11);
    EXPECT_NEAR(out.friction_Nm, friction_torque_Nm(p, in), 1e-11);
    in.gear_output_torque_Nm = 1e6;  // not used
    EXPECT_EQ(solve_gear_output(p, available_Nm, in).torque_Nm, out.torque_Nm);
  }
}

TEST(GearOutputTest, PreslidingSignIsBalancedToo) {
  const FrictionParameters p = full_friction();
  FrictionInput in = at(0.01, -25.0, 40.0);
  in.sign = -0.4;
  const double available_Nm = -25.0 + friction_torque_Nm(p, in);
  EXPECT_NEAR(solve_gear_output(p, available_Nm, in).torque_Nm, -25.0, 1e-12);
}

TEST(GearOutputTest, RisesContinuouslyWithTheTorqueThatIsAvailable) {
  for (const double speed : {-0.5, 0.5}) {
    double before = solve_gear_output(full_friction(), -50.0, at(speed)).torque_Nm;
    for (double available = -49.99; available < 50.0; available += 0.01) {
      const GearOutput out = solve_gear_output(full_friction(), available, at(speed));
      EXPECT_GT(out.torque_Nm, before);
      EXPECT_LT(out.torque_Nm - before, 0.02);
      before = out.torque_Nm;
    }
  }
}

TEST(GearOutputTest, SlopeIsThatOfFiniteDifferences) {
  for (const double available : {-80.0, -1.0, 20.0}) {
    const double above = solve_gear_output(loaded(), available + 1e-4, at(0.5)).torque_Nm;
    const double below = solve_gear_output(loaded(), available - 1e-4, at(0.5)).torque_Nm;
    EXPECT_NEAR(solve_gear_output(loaded(), available, at(0.5)).by_available, (above - below) / 2e-4, 1e-8);
  }
}

TEST(GearOutputTest, FrictionsGradientGivesTheTorquesOwn) {
  const FrictionVector here = to_vector(full_friction());
  for (FrictionInput in : many_points()) {
    const double available_Nm = in.gear_output_torque_Nm;
    const GearOutput out = solve_gear_output(full_friction(), available_Nm, in);
    in.gear_output_torque_Nm = out.torque_Nm;
    const FrictionVector gradient = evaluate(full_friction(), in).gradient;
    for (std::size_t i = 0; i < here.size(); ++i) {
      FrictionVector above = here;
      above[i] += 1e-6 * here[i];
      const double moved_Nm = solve_gear_output(test::from_vector(above), available_Nm, in).torque_Nm;
      const double difference = (moved_Nm - out.torque_Nm) / (1e-6 * here[i]);
      EXPECT_NEAR(-out.by_available * gradient[i], difference, 1e-4 * (1.0 + std::abs(difference)));
    }
  }
}

TEST(GearOutputTest, AtRestTheIntervalIsBreakawayAndLoadEitherWay) {
  FrictionParameters p = loaded();
  p.stribeck_Nm = 1.0;
  const GearOutput out = solve_gear_output(p, 29.0, at(0.0));
  EXPECT_DOUBLE_EQ(out.torque_Nm, 29.0);
  EXPECT_DOUBLE_EQ(out.low_Nm, (29.0 - 4.0) / 1.25);
  EXPECT_DOUBLE_EQ(out.high_Nm, (29.0 + 4.0) / 0.8);
}

TEST(GearOutputTest, IntervalHoldsTheTorqueOfEverySign) {
  for (FrictionInput in : many_points()) {
    const GearOutput out = solve_gear_output(full_friction(), in.gear_output_torque_Nm, in);
    double low = 1e9, high = -1e9;
    for (int i = -10; i <= 10; ++i) {
      FrictionInput of_sign = in;
      of_sign.sign = 0.1 * i;
      const double torque = solve_gear_output(full_friction(), in.gear_output_torque_Nm, of_sign).torque_Nm;
      low = std::min(low, torque);
      high = std::max(high, torque);
    }
    EXPECT_NEAR(out.low_Nm, low, 1e-12);
    EXPECT_NEAR(out.high_Nm, high, 1e-12);
  }
}

TEST(GearOutputTest, WithoutFrictionItIsWhatTheMotorGives) {
  const GearOutput out = solve_gear_output(FrictionParameters{}, 12.5, at(3.0));
  EXPECT_EQ(out.torque_Nm, 12.5);
  EXPECT_EQ(out.low_Nm, 12.5);
  EXPECT_EQ(out.high_Nm, 12.5);
}

}  // namespace
}  // namespace sprung
