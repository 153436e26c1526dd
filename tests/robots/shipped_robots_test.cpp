/// Shipped robots mean what they meant, however their files are written: every loaded value against a dump
/// that is kept in tests/robots/loaded_*.txt. To change a value on purpose: SPRUNG_WRITE_DUMPS=1 and look at
/// git diff.
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/robots/robot_dump.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

class ShippedRobot : public testing::TestWithParam<const char*> {};

TEST_P(ShippedRobot, LoadsAsItWasKeptValueByValue) {
  const std::string now = dump_of(load_robot(GetParam()));
  const std::string kept = test::kept_dump(test::source_dir() + "/tests/robots/loaded_" + GetParam() + ".txt",
                                           now);
  EXPECT_GT(kept.size(), 2000u);
  EXPECT_EQ(test::first_difference(kept, now), "");
}

TEST(RobotDump, TellsTheLastBitOfOneValueApart) {
  RobotConfig robot = load_robot("single_leg");
  const std::string before = dump_of(robot);
  robot.presets.back().walk.speed_damping[1] = 5e-324;
  EXPECT_EQ(test::first_difference(before, dump_of(robot)),
            "kept: presets[1].walk.speed_damping[1] = 0\n"
            "now:  presets[1].walk.speed_damping[1] = 4.9406564584124654e-324");
}

INSTANTIATE_TEST_SUITE_P(Robots, ShippedRobot,
                         testing::Values("fennec", "pegasus", "single_leg", "test_axis"));

}  // namespace
}  // namespace sprung
