#include "tools/logs/log/robot_names.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "runtime/process_options.h"
#include "sprung_msgs/process_status_t.hpp"
#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class RobotNamesTest : public testing::Test {
 protected:
  RobotNames names(const std::vector<Kept>& events) {
    write_all(path_, events);
    Reader reader(path_);
    const RobotNames found = names_in_log(reader);
    EXPECT_EQ(read_all(reader).size(), events.size());  // the reader is at its begin
    return found;
  }
  static Kept status(const std::string& robot, std::int64_t hash) {
    auto message = stamped<sprung_msgs::process_status_t>(0);
    message.robot = robot;
    message.configuration_hash = hash;
    return kept(channels::kProcessStatus, 0, encoded(message));
  }
  LogFolder folder_;
  std::string path_ = folder_("robot.lcm");
};

TEST_F(RobotNamesTest, AreThoseOfTheLogAndNotOfAFolderOnDisk) {
  const RobotNames found = names({metadata_event(robot_yaml("single_leg", "knee", "shin")), joint_event(0)});
  EXPECT_EQ(found.missing, "");
  EXPECT_EQ(found.lists[0].list, "joints");
  EXPECT_THAT(found.lists[0].names, ElementsAre("hip", "shin"));
}

TEST_F(RobotNamesTest, ALogWithoutItsRobotSaysSoAndWhatFollows) {
  const RobotNames found = names({joint_event(0)});
  EXPECT_TRUE(found.lists.empty());
  EXPECT_THAT(found.missing, HasSubstr(path_ + ": no robot.yaml is in it"));
  EXPECT_THAT(found.missing, HasSubstr("say joints[0], not joints[knee]"));
}

TEST_F(RobotNamesTest, ARobotFileThatCannotBeReadIsNamedWithItsMistake) {
  const RobotNames found = names({metadata_event(robot_yaml("single_leg", "gear_ratio:", "gear_ration:"))});
  EXPECT_TRUE(found.lists.empty());
  EXPECT_THAT(found.missing, HasSubstr("this sprung cannot read its robot.yaml: robot.yaml in it:"));
  EXPECT_THAT(found.missing, HasSubstr("gear_ratio"));
}

TEST_F(RobotNamesTest, LcmLoggersLogHasThemFromTheRobotFileThatItWasMadeWithAndFromNoOther) {
  const RobotConfig robot = load_robot("single_leg");
  EXPECT_THAT(names({status("single_leg", configuration_hash(robot, "paper"))}).lists[0].names,
              ElementsAre("hip", "knee"));
  const RobotNames other = names({status("single_leg", 4711)});
  EXPECT_TRUE(other.lists.empty());
  EXPECT_THAT(other.missing, HasSubstr("single_leg/robot.yaml is another than the one"));
  EXPECT_THAT(names({status("no_such_robot", 1)}).missing, HasSubstr("no robot 'no_such_robot'"));
}

}  // namespace
}  // namespace sprung::log
