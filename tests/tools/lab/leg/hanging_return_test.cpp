#include "tools/lab/leg/hanging_return.h"

#include <gtest/gtest.h>

#include <map>
#include <stdexcept>
#include <string>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class HangingReturnTest : public testing::Test {
 protected:
  HangingReturnResult run(const std::string& name, const std::map<std::string, double>& plant = {}) const {
    std::vector<HangingCase> cases;
    for (const HangingCase& config : hanging_cases(robot_, "best", false))
      if (config.name == name) cases.push_back(config);
    SimOptions sim;
    sim.seed = 1;
    sim.plant = plant;
    return run_hanging_return(robot_, sim, cases, {pulls_and_releases()[4]});
  }
  RobotConfig robot_ = load_robot("pegasus");
};

TEST_F(HangingReturnTest, CompensationBringsTheFootHomeAndWithoutItSticks) {
  const HangingReturnResult with = run("with");
  const HangingReturnResult without = run("without_as_is");
  ASSERT_EQ(with.cases.at(0).pulls.size(), 1u);
  EXPECT_LT(with.cases[0].summary.max_mm, 3.5);
  EXPECT_EQ(with.cases[0].summary.limit_cycles, 0);
  EXPECT_GT(with.cases[0].summary.moved_least_mm, 36.0);
  EXPECT_GT(without.cases.at(0).summary.max_mm, 3.0 * with.cases[0].summary.max_mm);
  EXPECT_EQ(with.cases[0].config.gains.stiffness_N_m, without.cases[0].config.gains.stiffness_N_m);
}

TEST_F(HangingReturnTest, CompensationIsHeldAgainstTheSameSpringsWithoutIt) {
  HangingReturnResult result;
  for (const HangingCase& config : hanging_cases(robot_, "best", false))
    if (config.name == "with" || config.name == "without_as_is") result.cases.push_back({config, {}, {}, {}});
  ASSERT_EQ(result.cases.size(), 2u);
  result.cases[0].summary.mean_mm = 4.0;
  result.cases[1].summary.mean_mm = 10.0;
  const ReportRow ratio = hanging_return_rows(result).back();
  EXPECT_EQ(ratio.name, "foot_return.with_over_without_as_is");
  EXPECT_DOUBLE_EQ(ratio.value, 0.4);
  EXPECT_FALSE(ratio.ok());
  result.cases[0].summary.mean_mm = 2.0;
  EXPECT_TRUE(hanging_return_rows(result).back().ok());
}

/// A firm hand swings with so light a foot until the bridge stops the robot.
TEST_F(HangingReturnTest, FootBehindAnElasticGearIsLedAwayAndComesBack) {
  const HangingReturnResult soft = run("with", {{"torsion", 1.0}, {"draw", 24.0}});
  ASSERT_EQ(soft.cases.at(0).pulls.size(), 1u);
  EXPECT_GT(soft.cases[0].summary.moved_least_mm, 20.0);
  EXPECT_LT(soft.cases[0].summary.max_mm, 0.5 * soft.cases[0].summary.moved_least_mm);
}

TEST_F(HangingReturnTest, ADrawnPlantIsAnotherOneAlready) {
  HangingReturnResult result;
  for (const HangingCase& config : hanging_cases(robot_, "best", true))
    result.cases.push_back({config, {}, {}, {}});
  ASSERT_EQ(result.cases.size(), 2u);
  int bounds = 0;
  for (const ReportRow& row : hanging_return_rows(result)) {
    if (row.name == "foot_return.with.mean") {
      EXPECT_EQ(*row.high, 2.0);
      ++bounds;
    }
    if (row.name == "foot_return.with.max") {
      EXPECT_EQ(*row.high, 4.0);
      ++bounds;
    }
  }
  EXPECT_EQ(bounds, 2);
}

TEST_F(HangingReturnTest, SameSeedGivesTheSameBits) {
  EXPECT_EQ(run("with").cases.at(0).summary.mean_mm, run("with").cases.at(0).summary.mean_mm);
}

TEST_F(HangingReturnTest, RowsHaveTheNamesAndBoundsOfTheIssue) {
  HangingReturnResult result;
  for (const HangingCase& config : hanging_cases(robot_, "best", false))
    result.cases.push_back({config, {}, {}, {}});
  int found = 0;
  for (const ReportRow& row : hanging_return_rows(result)) {
    if (row.name == "foot_return.with.mean") found += *row.high == 1.8;
    if (row.name == "foot_return.with.max") found += *row.high == 3.5;
    if (row.name == "foot_return.with_friction_120.max") found += *row.high == 4.0;
    if (row.name == "foot_return.without.mean") found += *row.paper == 8.91 && row.low && row.high;
  }
  EXPECT_EQ(found, 4);
}

TEST_F(HangingReturnTest, RobotThatDoesNotWalkIsRefused) {
  const RobotConfig leg = load_robot("single_leg");
  EXPECT_THROW(run_hanging_return(leg, {}, hanging_cases(leg, "best", false), pulls_and_releases()),
               std::runtime_error);
}

}  // namespace
}  // namespace sprung
