#include "tools/log/field_hint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "robot_sample.h"

namespace sprung::log {
namespace {

class FieldHintTest : public testing::Test {
 protected:
  FieldHintTest() { write_all(path_, robot_events(3)); }
  LogFolder folder_;
  std::string path_ = folder_("robot.lcm");
};

TEST_F(FieldHintTest, EveryChannelIsListedOnce) {
  const std::vector<std::string> names = field_names(path_);
  for (const char* name :
       {"JOINT_STATE.joints[0].gear_output_torque_Nm", "MOTION_STATE.state_name", "LOG_METADATA.robot"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
}

TEST_F(FieldHintTest, TheNearestFieldIsNamed) {
  EXPECT_EQ(no_field_text(path_, "JOINT_STATE.joints[0].gear_output_torqe_Nm"),
            path_ +
                " has no number or text named 'JOINT_STATE.joints[0].gear_output_torqe_Nm'; did you mean "
                "'JOINT_STATE.joints[0].gear_output_torque_Nm'? sprung log info lists channels, lcmtypes/ "
                "has their fields");
}

TEST_F(FieldHintTest, WhereNothingIsNearNothingIsGuessed) {
  EXPECT_EQ(
      no_field_text(path_, "X.y"),
      path_ +
          " has no number or text named 'X.y': sprung log info lists channels, lcmtypes/ has their fields");
}

}  // namespace
}  // namespace sprung::log
