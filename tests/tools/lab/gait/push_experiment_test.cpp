#include "tools/lab/gait/push_experiment.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/support/enumerators.h"

namespace sprung {
namespace {

const PushCase kCase{"stand", "stand", 0.0, 1, {10, 20, 30}, 20.0};

PushOutcome outcome(double impulse_Ns, PushDirection direction, bool fell) {
  PushOutcome out;
  out.name = "stand";
  out.impulse_Ns = impulse_Ns;
  out.direction = direction;
  out.vitals.fell = out.vitals.caught = fell;
  return out;
}

const ReportRow& push_experiment_row(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& row : rows)
    if (row.name == "push." + name) return row;
  throw std::out_of_range(name);
}

TEST(PushDirections, EveryOneHasItsOwnName) { test::expect_own_names<PushDirection>(); }

TEST(PushRows, TheSurvivedImpulseIsTheLargestBelowTheFirstFallToEitherSide) {
  const std::vector<PushOutcome> outcomes{
      outcome(10, PushDirection::kLeft, false),  outcome(10, PushDirection::kRight, false),
      outcome(20, PushDirection::kLeft, false),  outcome(20, PushDirection::kRight, true),
      outcome(30, PushDirection::kLeft, false),  outcome(30, PushDirection::kRight, false),
      outcome(10, PushDirection::kForward, true)};
  EXPECT_EQ(survived_impulse_Ns(kCase, outcomes, true), 10.0);
  EXPECT_EQ(survived_impulse_Ns(kCase, outcomes, false), 0.0);
  EXPECT_FALSE(push_experiment_row(push_rows({kCase}, outcomes), "stand.survived_impulse").ok());
}

TEST(PushRows, WithoutAFallItIsTheLargestTried) {
  const std::vector<PushOutcome> outcomes{outcome(30, PushDirection::kLeft, false)};
  EXPECT_EQ(survived_impulse_Ns(kCase, outcomes, true), 30.0);
  EXPECT_TRUE(push_experiment_row(push_rows({kCase}, outcomes), "stand.survived_impulse").ok());
}

TEST(PushRows, ATripIsNoSurvival) {
  std::vector<PushOutcome> outcomes{outcome(10, PushDirection::kLeft, false)};
  outcomes[0].vitals.trips = 1;
  EXPECT_EQ(survived_impulse_Ns(kCase, outcomes, true), 0.0);
  EXPECT_FALSE(push_experiment_row(push_rows({kCase}, outcomes), "stand.trips").ok());
}

TEST(PushRows, TheVoltageReserveIsThatOfWhoStayedUp) {
  std::vector<PushOutcome> outcomes{outcome(10, PushDirection::kLeft, false),
                                    outcome(20, PushDirection::kLeft, true)};
  outcomes[0].reserve = 0.05;
  outcomes[1].reserve = -0.4;
  EXPECT_NEAR(push_experiment_row(push_rows({kCase}, outcomes), "stand.voltage_reserve").value, 5.0, 1e-9);
  EXPECT_FALSE(push_experiment_row(push_rows({kCase}, outcomes), "stand.voltage_reserve").low)
      << "reported alone";
}

TEST(PushRows, HowFarTheCapturePointWasIsOfWhoStayedUp) {
  std::vector<PushOutcome> outcomes{outcome(10, PushDirection::kLeft, false),
                                    outcome(20, PushDirection::kLeft, true)};
  EXPECT_THROW((void)push_experiment_row(push_rows({kCase}, outcomes), "stand.capture_beyond"),
               std::out_of_range)
      << "nobody measured it";
  outcomes[0].capture_beyond = 0.1;
  outcomes[1].capture_beyond = 0.9;
  EXPECT_EQ(push_experiment_row(push_rows({kCase}, outcomes), "stand.capture_beyond").value, 0.1);
}

TEST(PushRows, AFallMustBeCaught) {
  std::vector<PushOutcome> outcomes{outcome(30, PushDirection::kLeft, true)};
  EXPECT_TRUE(push_experiment_row(push_rows({kCase}, outcomes), "stand.uncaught_falls").ok());
  outcomes[0].vitals.caught = false;
  EXPECT_FALSE(push_experiment_row(push_rows({kCase}, outcomes), "stand.uncaught_falls").ok());
}

TEST(Push, AStandingRobotIsMovedToTheSideThatItIsPushedToAndStaysUp) {
  const RobotConfig robot = load_robot("pegasus");
  const PushOutcome light = push_once(robot, {}, kCase, 5.0, PushDirection::kLeft);
  EXPECT_TRUE(light.stayed_up()) << light.vitals.why;
  EXPECT_EQ(light.survived, 1);
  const PushOutcome harder = push_once(robot, {}, kCase, 15.0, PushDirection::kLeft);
  EXPECT_GT(harder.tilt_most_rad, light.tilt_most_rad);
}

TEST(Push, AnImpulseThatNobodySurvivesIsSeen) {
  const PushOutcome out = push_once(load_robot("pegasus"), {}, kCase, 200.0, PushDirection::kRight);
  EXPECT_FALSE(out.stayed_up());
  EXPECT_EQ(out.survived, 0);
}

}  // namespace
}  // namespace sprung
