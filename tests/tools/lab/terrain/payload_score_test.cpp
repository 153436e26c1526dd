#include "tools/lab/terrain/payload_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

TEST(PayloadScore, IsAgainstWhatTheFeetTrulyCarryAndWhereThePayloadTrulyIs) {
  const RobotConfig robot = load_robot("pegasus");
  SimOptions sim;
  sim.plant = {{"payload", 6.0}, {"payload_x", 0.2}, {"payload_y", -0.05}};
  WalkingRobot standing(robot, "", lying(sim));
  PayloadScore score(robot);
  standing.run(0.2, [&score](InProcessRobot& r) { score.add(r); });
  const EstimatedPayload right{6.0, 1.0, {0.2, -0.05}};
  EXPECT_NEAR(score.mass_off_kg(right), 0.0, 0.1);
  EXPECT_NEAR(score.com_off_m(right), 0.0, 0.012) << "BodyShape counts legs at their middle: 10 mm";
  const EstimatedPayload wrong{4.0, 1.0, {-0.2, -0.05}};
  EXPECT_NEAR(score.mass_off_kg(wrong), 2.0, 0.1);
  EXPECT_GT(score.com_off_m(wrong), 0.04);
  EXPECT_TRUE(std::isnan(score.mass_off_kg({})));
  EXPECT_TRUE(std::isnan(score.com_off_m({6.0, 1.0, {kNaN, kNaN}})));
  // What the robot itself says after it has stood up.
  const EstimatedPayload said = standing.robot().motion_state().payload;
  EXPECT_LT(score.mass_off_kg(said), said.mass_bound_kg);
  EXPECT_LT(score.com_off_m(said), 0.03);
}

}  // namespace
}  // namespace sprung
