#include <gtest/gtest.h>

#include <cmath>

#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/motion_state.h"
#include "signals/vec3.h"
#include "tests/tools/logs/replay/logged_message.h"
#include "tools/logs/replay/difference_table.h"

namespace sprung {
namespace {

using test::message_of;

JointState joints(double torque_Nm) {
  JointState state(2, 1);
  state.stamp = {1000, 5};
  state.joints[1].gear_output_torque_Nm = torque_Nm;
  return state;
}

TEST(MessageComparison, SameBytesHaveNoDifference) {
  EXPECT_TRUE(MessageComparison().compare(message_of(joints(1.0)), message_of(joints(1.0))).empty());
}

TEST(MessageComparison, NamesFieldUnitAndBothValues) {
  const auto found = MessageComparison().compare(message_of(joints(1.0)), message_of(joints(1.5)));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].path, "joints[1].gear_output_torque_Nm");
  EXPECT_EQ(found[0].unit, "Nm");
  EXPECT_EQ(found[0].first, "1");
  EXPECT_EQ(found[0].second, "1.5");
  EXPECT_DOUBLE_EQ(found[0].difference, 0.5);
}

TEST(MessageComparison, ValuesHaveNoMoreDigitsThanTellThemApart) {
  const auto found = MessageComparison().compare(message_of(joints(0.9)), message_of(joints(0.8)));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].first, "0.9");
  EXPECT_EQ(found[0].second, "0.8");
}

TEST(MessageComparison, LastBitCanBeSeen) {
  const auto found = MessageComparison().compare(message_of(joints(1.0)),
                                                 message_of(joints(std::nextafter(1.0, 2.0))));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].first, found[0].second);
}

TEST(MessageComparison, SessionsMayDiffer) {
  EXPECT_TRUE(MessageComparison().compare(message_of(joints(1.0), 1), message_of(joints(1.0), 2)).empty());
}

TEST(MessageComparison, NumberAgainstNoneIsADifferenceWithoutASize) {
  const auto found = MessageComparison().compare(message_of(joints(kNaN)), message_of(joints(1.0)));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].first, "nan");
  EXPECT_TRUE(std::isnan(found[0].difference));
}

TEST(MessageComparison, TextsOfAnyLengthAreCompared) {
  MotionState standing(1), walking(1);
  standing.last_transition = "operator: stand";
  walking.last_transition = "operator: walk, and this is longer";
  const auto found = MessageComparison().compare(message_of(standing), message_of(walking));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].path, "last_transition");
  EXPECT_EQ(found[0].second, "operator: walk, and this is longer");
}

TEST(MessageComparison, OtherCountsOrTypesAreOneDifference) {
  MessageComparison comparison;
  const auto counts = comparison.compare(message_of(JointState(2, 1)), message_of(JointState(3, 1)));
  ASSERT_EQ(counts.size(), 1u);
  EXPECT_EQ(counts[0].path, "");
  const auto types = comparison.compare(message_of(JointState(2, 1)), message_of(DriveState(2)));
  ASSERT_EQ(types.size(), 1u);
  EXPECT_NE(types[0].second.find("drive_state_t"), std::string::npos);
}

TEST(MessageComparison, MissingOrDamagedMessageIsSaid) {
  MessageComparison comparison;
  const auto missing = comparison.compare(message_of(JointState(2, 1)), {});
  ASSERT_EQ(missing.size(), 1u);
  EXPECT_EQ(missing[0].second, "no message");
  Bytes damaged = message_of(JointState(2, 1));
  damaged.resize(50);
  const auto cut = comparison.compare(message_of(JointState(2, 1)), damaged);
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_NE(cut[0].second.find("not readable"), std::string::npos);
  EXPECT_TRUE(comparison.compare(damaged, damaged).empty());
}

}  // namespace
}  // namespace sprung
