#include "tools/logs/log/field_selection.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

class FieldSelectionTest : public testing::Test {
 protected:
  std::vector<std::string> paths(const std::vector<std::string>& texts,
                                 const std::string& channel = "JOINT_STATE") {
    FieldSelection selection(texts, {{"joints", {"hip", "knee"}}});
    const Kept event = joint_event(0);
    EXPECT_EQ(decoder_.open(event.data.data(), event.data.size(), message_), fields::Fault::kNone);
    std::vector<std::string> out;
    for (const fields::Field* field : selection.choose(channel, *message_.layout()))
      out.push_back(field->path);
    return out;
  }
  fields::Decoder decoder_;
  fields::MessageView message_;
};

using Paths = std::vector<std::string>;

TEST_F(FieldSelectionTest, ChannelAndPathArePartedAtTheFirstDot) {
  EXPECT_EQ(paths({"JOINT_STATE.joints[1].at_rest"}), Paths{"joints[1].at_rest"});
  EXPECT_EQ(paths({"JOINT_STATE.joints[knee].at_rest"}), Paths{"joints[1].at_rest"});
  EXPECT_EQ(paths({"*_STATE.joints[*].at_rest"}), (Paths{"joints[0].at_rest", "joints[1].at_rest"}));
  EXPECT_TRUE(paths({"DRIVE_STATE.joints[1].at_rest"}).empty());
}

TEST_F(FieldSelectionTest, ARegularExpressionOfAChannelMayHoldDots) {
  EXPECT_EQ(paths({"/JOINT.S.*/.joints[0].at_rest"}), Paths{"joints[0].at_rest"});
  EXPECT_THROW(paths({"/(/.x"}), std::invalid_argument);
}

TEST_F(FieldSelectionTest, AChannelAloneIsAllOfItAndSoIsNothing) {
  EXPECT_EQ(paths({"JOINT_STATE"}), paths({}));
  EXPECT_GT(paths({}).size(), 40u);
}

TEST_F(FieldSelectionTest, ColumnsAreTheSameInEveryShape) {
  FieldSelection selection({"JOINT_STATE.joints[*].at_rest"});
  ChosenFields chosen;
  const Kept two = joint_event(0);
  auto one = stamped<sprung_msgs::joint_state_t>(1);
  one.n_joints = 1;
  one.joints.resize(1);
  const std::string bytes = encoded(one);
  decoder_.open(two.data.data(), two.data.size(), message_);
  EXPECT_EQ(chosen.of(message_, "JOINT_STATE", selection).size(), 2u);
  decoder_.open(bytes.data(), bytes.size(), message_);
  const auto& fields = chosen.of(message_, "JOINT_STATE", selection);
  ASSERT_EQ(fields.size(), 1u);
  EXPECT_EQ(fields[0].column, 0u);
  EXPECT_EQ(chosen.columns().size(), 2u);
}

TEST_F(FieldSelectionTest, FixedColumnsStayAsTheyAre) {
  FieldSelection selection({"JOINT_STATE.joints[*].at_rest"});
  ChosenFields chosen;
  chosen.fix_columns();
  const Kept two = joint_event(0);
  decoder_.open(two.data.data(), two.data.size(), message_);
  EXPECT_TRUE(chosen.of(message_, "JOINT_STATE", selection).empty());
  EXPECT_TRUE(chosen.columns().empty());
}

}  // namespace
}  // namespace sprung::log
