#include "estimator/leg_windings.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

class LegWindingsTest : public testing::Test {
 protected:
  EstimatedJoint after(double current_A, double seconds) {
    for (ActuatorState& one : actuators_) one.measured_current_A = current_A;
    const double dt_s = robot_.cycle_s;
    for (double t = 0.0; t < seconds; t += dt_s) windings_.step(actuators_, dt_s);
    EstimatedJoint out;
    windings_.write(2, out);
    return out;
  }

  RobotConfig robot_ = load_robot("pegasus");
  std::vector<ActuatorState> actuators_{robot_.actuators.size()};
  LegWindings windings_{robot_, robot_.legs[0]};
};

TEST_F(LegWindingsTest, TwiceTheRatedCurrentIsTooMuchInTheTimeThatItSays) {
  const EstimatedJoint soon = after(2.0 * 2.12, 1.0);
  EXPECT_GT(soon.winding_share, 0.0);
  EXPECT_LT(soon.winding_share, 0.1);
  after(2.0 * 2.12, 8.0);
  const EstimatedJoint later = after(2.0 * 2.12, 1.0);
  ASSERT_GT(later.derating_in_s, 1.0);
  EXPECT_LT(after(2.0 * 2.12, later.derating_in_s - 2.0).winding_share, 1.0);
  EXPECT_EQ(after(2.0 * 2.12, 4.0).derating_in_s, 0.0);
}

TEST_F(LegWindingsTest, TheRatedCurrentIsNeverTooMuch) {
  const EstimatedJoint out = after(0.99 * 2.12, 30.0);
  EXPECT_TRUE(std::isnan(out.derating_in_s));
  EXPECT_NEAR(out.winding_share, 0.98 * (1.0 - std::exp(-30.0 / 52.6)), 0.01);
}

TEST_F(LegWindingsTest, ADriveThatIsSilentGoesOnWithItsLastCurrent) {
  after(2.12, 1.0);
  const double before = after(2.12, 1.0).winding_share;
  EXPECT_GT(after(kNaN, 10.0).winding_share, before + 0.05);
}

TEST_F(LegWindingsTest, WithoutATimeConstantNothingIsKnown) {
  for (ActuatorConfig& actuator : robot_.actuators) actuator.winding_time_constant_s = 0.0;
  windings_ = LegWindings(robot_, robot_.legs[0]);
  EXPECT_TRUE(std::isnan(after(5.0, 10.0).winding_share));
}

}  // namespace
}  // namespace sprung
