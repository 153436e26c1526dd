#include "planner/gait/gait_order.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

const GaitConfig& gait(const RobotConfig& robot, const char* name) {
  for (const GaitConfig& g : robot.gaits)
    if (g.name == name) return g;
  throw std::out_of_range(name);
}

class GaitOrderTest : public testing::TestWithParam<const char*> {
 protected:
  const RobotConfig robot_ = load_robot(GetParam());
  const BodyShape shape_{robot_};
};

TEST_P(GaitOrderTest, BackwardEachLegTakesTheTurnOfTheOneOnItsSideAtTheOtherEnd) {
  const GaitConfig& crawl = gait(robot_, "crawl");
  const GaitConfig back = backward_order(crawl, shape_);
  int mirrored = 0;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3& a = robot_.legs[i].hip_in_trunk_m;
      const Vec3& b = robot_.legs[k].hip_in_trunk_m;
      if (a[0] * b[0] > 0.0 || a[1] * b[1] < 0.0) continue;
      EXPECT_EQ(back.offsets[i], crawl.offsets[k]) << robot_.legs[i].name;
      ++mirrored;
    }
  EXPECT_EQ(mirrored, 4);
  EXPECT_NE(back.offsets, crawl.offsets);
  EXPECT_EQ(back.period_s, crawl.period_s);
}

TEST_P(GaitOrderTest, TwiceBackwardIsForward) {
  const GaitConfig& crawl = gait(robot_, "crawl");
  EXPECT_EQ(backward_order(backward_order(crawl, shape_), shape_).offsets, crawl.offsets);
}

TEST_P(GaitOrderTest, TrotAndStandAreTheirOwnMirrorImages) {
  for (const char* name : {"trot", "stand"})
    EXPECT_EQ(backward_order(gait(robot_, name), shape_).offsets, gait(robot_, name).offsets) << name;
}

INSTANTIATE_TEST_SUITE_P(Quadrupeds, GaitOrderTest, testing::Values("pegasus", "fennec"));

}  // namespace
}  // namespace sprung
