#include "tools/operate/launcher/record_command.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

TEST(RecordCommand, NamesRobotJointFileAndTheKnownWeight) {
  const RobotConfig robot = load_robot("single_leg");
  const std::string knee = record_command(robot, robot.joints[1]);
  EXPECT_EQ(knee.rfind("sprung identify --record single_leg knee --suspended --loaded --out knee.lcm", 0), 0u)
      << knee;
  EXPECT_NE(knee.find("--weight"), std::string::npos) << knee;
}

TEST(RecordCommand, OfANoteTheFirstJointsCommandIsToldAndThatThereAreMore) {
  const RobotConfig robot = load_robot("single_leg");
  EXPECT_EQ(recordings_to_repeat(robot, "the model does not fit what moves: knee (friction)"),
            record_command(robot, robot.joints[1]));
  EXPECT_EQ(recordings_to_repeat(robot, "the model does not fit what moves: hip (weight), knee (friction)"),
            record_command(robot, robot.joints[0]) + "; the other joints alike");
  EXPECT_EQ(recordings_to_repeat(robot, "something else"), "");
}

/// A joint's name may be the end of another's.
TEST(RecordCommand, ANameIsAWholeWord) {
  const RobotConfig robot = load_robot("pegasus");
  EXPECT_EQ(recordings_to_repeat(robot, "the model does not fit what moves: hr_knee (inertia)"),
            record_command(robot, robot.joints[11]));
}

}  // namespace
}  // namespace sprung
