#include "tools/lab/campaign/injection.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung::campaign {
namespace {

class InjectionTest : public testing::Test {
 protected:
  Injection mistake(FileMistake kind, double value = 0.0) {
    Injection out;
    out.kind = Class::kFile;
    out.mistake = kind;
    out.value = value;
    return out;
  }
  const RobotConfig robot_ = load_robot("single_leg");
};

TEST_F(InjectionTest, LastsFromItsCycleForItsTime) {
  Injection one;
  one.at_seq = 10;
  one.duration_s = 0.003;
  EXPECT_FALSE(one.active(9, 0.001));
  EXPECT_TRUE(one.active(10, 0.001));
  EXPECT_TRUE(one.active(12, 0.001));
  EXPECT_FALSE(one.active(13, 0.001));
  one.duration_s = 0.0;
  EXPECT_TRUE(one.active(1'000'000, 0.001)) << "for good";
}

TEST_F(InjectionTest, MistakesChangeWhatTheyName) {
  const ActuatorConfig& hip = robot_.actuators[0];
  EXPECT_EQ(with_mistake(robot_, mistake(FileMistake::kSign)).actuators[0].direction, -hip.direction);
  const RobotConfig swapped = with_mistake(robot_, mistake(FileMistake::kSwapped));
  EXPECT_EQ(swapped.actuators[0].node, robot_.actuators[1].node);
  EXPECT_EQ(swapped.actuators[1].node, hip.node);
  EXPECT_DOUBLE_EQ(with_mistake(robot_, mistake(FileMistake::kZero, 0.3)).actuators[0].offset_rad,
                   hip.offset_rad + 0.3);
  EXPECT_DOUBLE_EQ(with_mistake(robot_, mistake(FileMistake::kRatio, 2.0)).actuators[0].torque_constant_Nm_A,
                   2.0 * hip.torque_constant_Nm_A);
  Injection other;
  other.kind = Class::kDrive;
  EXPECT_EQ(with_mistake(robot_, other).actuators[0].direction, hip.direction);
}

TEST_F(InjectionTest, WordsNameWhatWhereAndHowLong) {
  Injection one;
  one.kind = Class::kDrive;
  one.drive_fault = FaultKind::kEncoderStuck;
  one.target = 1;
  one.duration_s = 0.25;
  EXPECT_EQ(text_of(one, robot_), "encoder-stuck of knee_motor for 0.250 s");
}

}  // namespace
}  // namespace sprung::campaign
