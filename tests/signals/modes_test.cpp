#include "signals/modes.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace sprung {
namespace {

template <class E>
void expect_distinct_names(E last) {
  std::set<std::string> names;
  for (int value = 0; value <= static_cast<int>(last); ++value) {
    const std::string text = name(static_cast<E>(value));
    EXPECT_TRUE(names.insert(text).second) << text;
    EXPECT_FALSE(text.empty());
  }
}

TEST(Modes, EveryValueHasItsOwnName) {
  expect_distinct_names(DriveMode::kPosition);
  expect_distinct_names(PowerState::kFault);
  expect_distinct_names(SafetyLevel::kDisabled);
  expect_distinct_names(SafetyCause::kDuplicateNode);
  expect_distinct_names(JointStatus::kFault);
  expect_distinct_names(ControlMode::kJoint);
  expect_distinct_names(LegPhase::kStance);
  expect_distinct_names(MotionPhase::kFallen);
  expect_distinct_names(LegEvent::kStumble);
  expect_distinct_names(GaitControl::kOwn);
  expect_distinct_names(JumpMode::kOwn);
  expect_distinct_names(OperatorKind::kWalk);
  expect_distinct_names(OperatorOutcome::kQueued);
  expect_distinct_names(ProcessState::kStopping);
  expect_distinct_names(FaultKind::kQueueFull);
  expect_distinct_names(BusCondition::kOff);
  expect_distinct_names(ReferenceSource::kJig);
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
  EXPECT_EQ(static_cast<int>(GaitControl::kOwn), 3);
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
