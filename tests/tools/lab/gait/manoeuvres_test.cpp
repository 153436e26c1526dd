#include "tools/lab/gait/manoeuvres.h"

#include <gtest/gtest.h>

#include <set>

#include "robots/gait_speed.h"
#include "robots/robot_loader.h"
#include "tools/lab/gait/legged_trial.h"

namespace sprung {
namespace {

TEST(Manoeuvres, EveryGaitThatGoesIsTriedInEveryDirectionAtItsFastest) {
  const RobotConfig robot = load_robot("pegasus");
  std::set<std::string> names;
  for (const Manoeuvre& one : manoeuvres(robot)) {
    EXPECT_NE(one.gait, "stand");
    EXPECT_TRUE(names.insert(one.gait + "." + one.direction).second);
    const GaitConfig& gait = robot.gaits[static_cast<std::size_t>(gait_index(robot, one.gait))];
    EXPECT_NEAR(speed_share(gait, one.speed), 1.0, 1e-9) << one.direction;
  }
  EXPECT_EQ(names.size(), 15u);
  EXPECT_TRUE(names.count("trot.backward"));
}

TEST(Manoeuvres, WhoFellHasFailedAndTooLittleVoltageIsRefused) {
  ManoeuvreOutcome outcome;
  outcome.what = {"trot", "backward", {-0.3, 0.0, 0.0}};
  outcome.reserve.least = 0.11;
  auto rows = manoeuvre_rows({outcome});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].name, "walk.trot.backward.stays_up");
  EXPECT_EQ(rows[1].name, "walk.trot.backward.voltage_reserve");
  EXPECT_TRUE(all_ok(rows));
  outcome.reserve.least = 0.09;
  EXPECT_FALSE(manoeuvre_rows({outcome})[1].ok());
  outcome.vitals.fell = true;
  EXPECT_FALSE(manoeuvre_rows({outcome})[0].ok());
}

TEST(Manoeuvres, WithoutWindingsThereIsNoReserve) {
  EXPECT_EQ(manoeuvre_rows({ManoeuvreOutcome{{"crawl", "turning", {}}, {}, {}, 0.0}}).size(), 1u);
}

/// A robot that goes, in one of them: whole stack, in this process.
TEST(Manoeuvres, ACurveIsWalkedAndItsVoltageWatched) {
  const RobotConfig robot = load_robot("pegasus");
  SimOptions sim;
  sim.seed = 1;
  sim.plant["winding"] = 1.0;
  int walked = 0;
  for (const Manoeuvre& one : manoeuvres(robot)) {
    if (one.gait != "trot" || one.direction != "curve") continue;
    const ManoeuvreOutcome outcome = manoeuvre(robot, "best", sim, one);
    EXPECT_FALSE(outcome.vitals.fell);
    EXPECT_GT(outcome.reserve.least, 0.1);
    EXPECT_LT(outcome.reserve.least, 0.8);
    EXPECT_FALSE(outcome.reserve.actuator.empty());
    ++walked;
  }
  EXPECT_EQ(walked, 1);
}

}  // namespace
}  // namespace sprung
