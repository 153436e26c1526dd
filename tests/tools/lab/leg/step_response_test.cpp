#include "tools/lab/leg/step_response.h"

#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class StepResponseTest : public testing::Test {
 protected:
  static StepResponseResult run() {
    SimOptions sim;
    sim.seed = 1;
    return run_step_response(load_robot("single_leg"), "paper", sim, run_in_process);
  }
  static void SetUpTestSuite() { result_ = new StepResponseResult(run()); }
  static void TearDownTestSuite() { delete result_; }
  static const StepResult& of(const std::string& name) {
    for (const StepResult& done : result_->cases) {
      if (done.config.name == name) return done;
    }
    throw std::invalid_argument(name);
  }
  static StepResponseResult* result_;
};

StepResponseResult* StepResponseTest::result_ = nullptr;

TEST_F(StepResponseTest, ThrustPeaksAfterSixMillisecondsOnTheMotorAndMuchLaterAtTheOutput) {
  const StepResult& thrust = of("thrust");
  EXPECT_NEAR(thrust.estimated_motor_side.peak_ms, 6.0, 1.01);
  EXPECT_LT(thrust.estimated_motor_side.t90_ms, thrust.estimated_motor_side.peak_ms);
  EXPECT_GT(thrust.output.t90_ms, 3.0 * thrust.estimated_motor_side.t90_ms);
}

/// 94 Hz: 3.9 ms to 90 %, after a cycle on the way to the drive.
TEST_F(StepResponseTest, MotorsTorqueFollowsItsLoopWhateverTheFloor) {
  for (const char* name : {"rigid_floor", "floor_like_gear"}) {
    EXPECT_NEAR(of(name).motor.t90_ms, 4.9, 0.3) << name;
    EXPECT_NEAR(of(name).estimated_motor_side.t90_ms, of(name).motor.t90_ms, 1.5) << name;
    EXPECT_TRUE(std::isnan(of(name).motor.peak_ms)) << name;
  }
}

TEST_F(StepResponseTest, StepIsTheForceTimesTheKneesLever) {
  const StepFigures& s = of("rigid_floor").motor;
  EXPECT_NEAR(std::abs(s.end_Nm - s.start_Nm), 200.0 * 0.245, 1.0);
}

/// Errata E10: 36 Hz, so the output peaks half a period, 14 ms, after the motor.
TEST_F(StepResponseTest, RotorOnASpringAsStiffAsAGearOvershootsAfterHalfAPeriod) {
  const StepResult& soft = of("floor_like_gear");
  EXPECT_NEAR(soft.output.peak_ms, 14.0 + 2.7, 2.0);
  EXPECT_GT(soft.output.t90_ms, of("rigid_floor").output.t90_ms + 2.0);
}

TEST_F(StepResponseTest, RunsAreTheSameBits) {
  const StepResponseResult again = run();
  for (std::size_t i = 0; i < again.cases.size(); ++i) {
    EXPECT_EQ(again.cases[i].knee.output_Nm, result_->cases[i].knee.output_Nm);
    EXPECT_EQ(again.cases[i].knee.estimated_motor_side_Nm, result_->cases[i].knee.estimated_motor_side_Nm);
  }
}

TEST_F(StepResponseTest, RowsOfTheThrustAreThePapersAndOthersAreNamedByCase) {
  const std::vector<ReportRow> rows = step_response_rows(*result_);
  ASSERT_EQ(rows.size(), 12u);
  EXPECT_EQ(rows[0].name, "step_response.motor.peak");
  EXPECT_EQ(*rows[0].paper, 4.75);
  EXPECT_EQ(rows[3].name, "step_response.output.t90");
  EXPECT_EQ(rows[4].name, "step_response.rigid_floor.motor.peak");
  EXPECT_FALSE(rows[4].paper);
  EXPECT_EQ(*rows[1].high, 4.75);  // S0's torque has its peak then
  EXPECT_EQ(*rows[7].high, 13.0);  // ANYmal's, which S0 compares with
  EXPECT_EQ(*rows[10].low, 11.0);  // errata E10
  EXPECT_EQ(*rows[10].high, 19.0);
  for (const ReportRow& row : rows) EXPECT_TRUE(row.ok()) << row.name;
}

TEST_F(StepResponseTest, ReportShowsThreeSignalsOfEveryCase) {
  const report::Section section = step_response_section(*result_);
  EXPECT_EQ(section.tables.at(0).rows.size(), 9u);
  ASSERT_EQ(section.plots.size(), 3u);
  EXPECT_EQ(section.plots[0].series.size(), 3u);
}

TEST_F(StepResponseTest, RobotThatIsNoPlanarLegIsRefused) {
  EXPECT_THROW(run_step_response(load_robot("pegasus"), "best", {}, run_in_process), std::invalid_argument);
}

TEST_F(StepResponseTest, PresetThatRampsItsSpringsIsRefused) {
  try {
    run_step_response(load_robot("single_leg"), "best", {}, run_in_process);
    FAIL();
  } catch (const std::invalid_argument& why) {
    EXPECT_THAT(why.what(), testing::HasSubstr("stiffness_ramp"));
  }
}

}  // namespace
}  // namespace sprung
