#include "tools/logs/log/field_hint.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

class FieldHintTest : public testing::Test {
 protected:
  FieldHintTest() { write_all(path_, robot_events(3)); }
  LogFolder folder_;
  std::string path_ = folder_("robot.lcm");
};

TEST_F(FieldHintTest, EveryChannelIsListedOnce) {
  std::vector<std::string> names;
  for (const FieldName& one : field_names(path_)) names.push_back(one.path);
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

/// Joint 0 of pegasus is fl_abduction; by letters alone fl_hip is nearer to what was typed.
TEST_F(FieldHintTest, AnIndexStaysThatJointAndIsShownWithItsName) {
  auto message = stamped<sprung_msgs::joint_state_t>(0);
  message.n_joints = 12;
  message.joints.resize(12);
  write_all(path_, {metadata_event(robot_yaml("pegasus")), kept(channels::kJointState, 0, encoded(message))});
  const auto meant = [&](const std::string& typed) {
    const std::string text = no_field_text(path_, typed);
    const std::size_t begin = text.find("did you mean '") + 14;
    return text.substr(begin, text.find('\'', begin) - begin);
  };
  EXPECT_EQ(meant("JOINT_STATE.joints[0].gear_torque_Nm"),
            "JOINT_STATE.joints[fl_abduction].gear_output_torque_Nm");
  EXPECT_EQ(meant("JOINT_STATE.joint[0].status"), "JOINT_STATE.joints[fl_abduction].status");
  EXPECT_EQ(meant("JOINT_STATE.joints[11].statsu"), "JOINT_STATE.joints[hr_knee].status");
  EXPECT_EQ(meant("JOINT_STATE.joints[fl_hip].statsu"), "JOINT_STATE.joints[fl_hip].status");
  EXPECT_EQ(meant("JOINT_STATE.joints[*].statsu"), "JOINT_STATE.joints[*].status");
}

TEST_F(FieldHintTest, AChannelOfAnotherVersionIsNamedAsThat) {
  std::string old = encoded(stamped<sprung_msgs::joint_state_t>(0));
  old[0] = static_cast<char>(old[0] ^ 0x40);  // the fingerprint
  write_all(path_, {metadata_event(robot_yaml("pegasus")), kept(channels::kJointState, 0, old)});
  EXPECT_EQ(no_field_text(path_, "JOINT_STATE.joints[0].status"),
            path_ +
                ": its JOINT_STATE is a message of another version of sprung, and only that one knows its "
                "fields; sprung log info names the version");
}

TEST_F(FieldHintTest, WhereNothingIsNearNothingIsGuessed) {
  EXPECT_EQ(
      no_field_text(path_, "X.y"),
      path_ +
          " has no number or text named 'X.y': sprung log info lists channels, lcmtypes/ has their fields");
}

}  // namespace
}  // namespace sprung::log
