#include "signals/modes.h"

#include <gtest/gtest.h>

#include "tests/support/enumerators.h"

namespace sprung {
namespace {

TEST(Modes, EveryValueHasItsOwnName) {
  test::expect_own_names<DriveMode>();
  test::expect_own_names<PowerState>();
  test::expect_own_names<SafetyLevel>();
  test::expect_own_names<SafetyCause>();
  test::expect_own_names<JointStatus>();
  test::expect_own_names<ControlMode>();
  test::expect_own_names<LegPhase>();
  test::expect_own_names<MotionPhase>();
  test::expect_own_names<LegEvent>();
  test::expect_own_names<GaitControl>();
  test::expect_own_names<JumpMode>();
  test::expect_own_names<OperatorKind>();
  test::expect_own_names<OperatorOutcome>();
  test::expect_own_names<ProcessState>();
  test::expect_own_names<ImuStatus>();
  test::expect_own_names<SimControlKind>();
  test::expect_own_names<FaultKind>();
  test::expect_own_names<BusCondition>();
  test::expect_own_names<ReferenceSource>();
  test::expect_own_names<LogEndReason>();
}

TEST(Modes, EveryLegEventHasItsCounter) {
  EXPECT_EQ(kLegEventCount, static_cast<std::size_t>(LegEvent::kStumble) + 1);
}

TEST(Modes, WalkingsValuesOnTheWireStayWhatTheyAre) {
  EXPECT_EQ(static_cast<int>(LegPhase::kSwing), 7);
  EXPECT_EQ(static_cast<int>(LegPhase::kStance), 9);
  EXPECT_EQ(static_cast<int>(MotionPhase::kWalking), 11);
  EXPECT_EQ(static_cast<int>(MotionPhase::kFallen), 12);
  EXPECT_EQ(static_cast<int>(OperatorKind::kWalk), 11);
  EXPECT_EQ(static_cast<int>(GaitControl::kForce), 0);
  EXPECT_EQ(static_cast<int>(GaitControl::kAdaptive), 3);
}

TEST(Modes, ValueOffTheWireThatIsUnknownStillHasAName) {
  EXPECT_STREQ(name(static_cast<DriveMode>(99)), "unknown");
  EXPECT_STREQ(name(static_cast<SafetyCause>(-1)), "unknown");
  EXPECT_STREQ(name(static_cast<LegEvent>(6)), "unknown");
  EXPECT_STREQ(name(static_cast<GaitControl>(4)), "unknown");
  EXPECT_STREQ(name(static_cast<MotionPhase>(13)), "unknown");
}

}  // namespace
}  // namespace sprung
