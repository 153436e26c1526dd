#include "tools/lab/estimation/model_watch_experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::Each;
using testing::Field;

RobotConfig with_best_alone() {
  RobotConfig robot = load_robot("single_leg");
  robot.presets = {robot.preset("best")};
  return robot;
}

TEST(ModelWatchExperiment, ItsOwnGearsFitAllTheTime) {
  const auto joints = watch_models(with_best_alone(), {}, {});
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_THAT(joints, Each(Field(&WatchedJoint::misfit_after_s, std::nullopt)));
  EXPECT_GT(joints[0].motion_s, 10.0);
  EXPECT_LT(joints[0].motion_s, joints[0].simulated_s);
}

TEST(ModelWatchExperiment, GearsWithTwiceTheFrictionAreSeen) {
  SimOptions sim;
  sim.plant["friction_scale"] = 2.0;
  const auto joints = watch_models(with_best_alone(), sim, {});
  for (const WatchedJoint& joint : joints) {
    ASSERT_TRUE(joint.misfit_after_s) << joint.name;
    EXPECT_LT(*joint.misfit_after_s, 5.0) << joint.name;
  }
}

TEST(ModelWatchExperiment, RowsSayShareWithinASecondAndShareThatFits) {
  const auto rows = model_watch_rows(
      {{"hip", 9.0, 0.5, 12.0}, {"knee", 9.0, 2.5, 12.0}, {"ankle", 9.0, {}, 12.0}});
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(rows[0].name, "model_watch.hip.misfit_after");
  EXPECT_EQ(rows[0].value, 0.5);
  EXPECT_TRUE(std::isnan(rows[2].value));
  EXPECT_NEAR(rows[3].value, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(rows[4].value, 1.0 / 3.0, 1e-12);
  EXPECT_FALSE(rows[4].ok());
}

}  // namespace
}  // namespace sprung
