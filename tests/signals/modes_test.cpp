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
  expect_distinct_names(MotionPhase::kComplying);
  expect_distinct_names(JumpMode::kOwn);
  expect_distinct_names(OperatorKind::kLand);
  expect_distinct_names(OperatorOutcome::kQueued);
  expect_distinct_names(ProcessState::kStopping);
}

TEST(Modes, ValueOffTheWireThatIsUnknownStillHasAName) {
  EXPECT_STREQ(name(static_cast<DriveMode>(99)), "unknown");
  EXPECT_STREQ(name(static_cast<SafetyCause>(-1)), "unknown");
}

}  // namespace
}  // namespace sprung
