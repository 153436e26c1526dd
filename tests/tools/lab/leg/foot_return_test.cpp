#include "tools/lab/leg/foot_return.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "planner/operator_desk.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

class FootReturnTest : public testing::Test {
 protected:
  /// Two pulls of the strongest force, in each of two directions.
  FootReturnCase few(const std::string& name) const {
    for (FootReturnCase& config : foot_return_cases(robot_.preset("best"))) {
      if (config.name != name) continue;
      FootReturnCase out = config;
      out.script.pulls = {config.script.pulls[9], config.script.pulls[34]};
      return out;
    }
    throw std::invalid_argument(name);
  }
  FootReturnResult run(const std::string& name) const {
    SimOptions sim;
    sim.seed = 1;
    return run_foot_return(robot_, "best", sim, {few(name)}, run_in_process);
  }
  RobotConfig robot_ = load_robot("single_leg");
};

TEST_F(FootReturnTest, FootPullsEachForceInEachDirectionAtItsCycle) {
  const FootReturnScript script = foot_return_cases(robot_.preset("best")).front().script;
  const std::vector<SimControl> controls = hand(script, robot_.cycle_s);
  ASSERT_EQ(controls.size(), 40u);
  EXPECT_EQ(controls[0].apply_at_seq, 1500 + 1200);
  EXPECT_EQ(controls[1].apply_at_seq - controls[0].apply_at_seq, 4700);
  EXPECT_NEAR(controls[10].wrench[2], script.pulls[10].force_N, 1e-9);  // the third direction is up
  EXPECT_NEAR(controls[10].wrench[0], 0.0, 1e-9);
}

TEST_F(FootReturnTest, RunsAreShortEnoughForThePlannersDeskAndMissNoPull) {
  const FootReturnScript script = foot_return_cases(robot_.preset("best")).front().script;
  std::vector<double> forces_N;
  for (const FootReturnScript& run : runs_of(script)) {
    EXPECT_LE(orders(run, robot_.cycle_s).size(), static_cast<std::size_t>(OperatorDesk::kMostWaiting));
    EXPECT_EQ(run.stiffness_N_m, script.stiffness_N_m);
    for (const FootPull& pull : run.pulls) forces_N.push_back(pull.force_N);
  }
  ASSERT_EQ(forces_N.size(), script.pulls.size());
  for (std::size_t i = 0; i < forces_N.size(); ++i) EXPECT_EQ(forces_N[i], script.pulls[i].force_N);
}

TEST_F(FootReturnTest, OperatorStandsThenCompliesBeforeEveryPullAndStopsAfterIt) {
  const FootReturnScript script = few("without").script;
  const std::vector<OperatorCommand> said = orders(script, robot_.cycle_s);
  ASSERT_EQ(said.size(), 4u);
  EXPECT_EQ(said[0].kind, OperatorKind::kStand);
  EXPECT_EQ(said[1].kind, OperatorKind::kComply);
  EXPECT_EQ(said[1].apply_at_seq, 1500 + 1000);
  EXPECT_EQ(said[1].stiffness_N_m, (Vec3{2000.0, 0.0, 2000.0}));
  EXPECT_EQ(said[1].friction_compensation, 0.0);
  EXPECT_EQ(said[2].kind, OperatorKind::kStop);
  EXPECT_EQ(said[2].apply_at_seq, 1500 + 4700);
  EXPECT_EQ(said[3].kind, OperatorKind::kComply);
}

TEST_F(FootReturnTest, CommandThatIsRefusedEndsTheExperiment) {
  RobotConfig slow = robot_;
  for (PresetConfig& preset : slow.presets) preset.rise_time_s = 3.0;  // not standing when it is to comply
  EXPECT_THROW(run_foot_return(slow, "best", {}, {few("with")}, run_in_process), std::runtime_error);
}

TEST_F(FootReturnTest, CompensationBringsTheFootHomeAndTheSpringIsFelt) {
  const FootReturnSummary with = run("with").cases.front().summary;
  const FootReturnSummary without = run("without").cases.front().summary;
  EXPECT_LT(with.max_mm, 3.5);
  EXPECT_EQ(with.limit_cycles, 0);
  EXPECT_LT(with.settled_worst_s, 1.5);
  EXPECT_GT(with.moved_least_mm, 30.0);
  EXPECT_GT(without.mean_mm, 3.0 * with.mean_mm);
}

TEST_F(FootReturnTest, LessFrictionThanIdentifiedMakesNoLimitCycle) {
  const FootReturnSummary s = run("with_friction_80").cases.front().summary;
  EXPECT_EQ(s.limit_cycles, 0);
  EXPECT_LT(s.mean_mm, 2.0);
}

TEST_F(FootReturnTest, MoreFrictionThanIdentifiedIsFoundByTheFootThatIsStuck) {
  const FootReturnSummary s = run("with_most").cases.front().summary;
  EXPECT_LT(s.mean_mm, 2.0);
  EXPECT_LT(s.max_mm, 4.0);
  EXPECT_EQ(s.limit_cycles, 0);
}

TEST_F(FootReturnTest, OtherPlantsAreTimesWhatIsAskedFor) {
  SimOptions asked;
  asked.plant["friction_scale"] = 0.5;
  const SimOptions on = on_plant(asked, {1.2, 0.9, 1.0});
  EXPECT_DOUBLE_EQ(on.plant.at("friction_scale"), 0.6);
  EXPECT_DOUBLE_EQ(on.plant.at("mass_scale"), 0.9);
  EXPECT_EQ(on.plant.count("kt_scale"), 0U);
}

TEST_F(FootReturnTest, RunsAreTheSameBitsAndRowsAreNamedByCase) {
  const FootReturnResult first = run("with");
  const FootReturnResult second = run("with");
  EXPECT_EQ(first.cases[0].pulls[1].back_m.x_m, second.cases[0].pulls[1].back_m.x_m);
  const std::vector<ReportRow> rows = foot_return_rows(first);
  EXPECT_EQ(rows.front().name, "foot_return.with.mean");
  EXPECT_EQ(*rows.front().high, 1.8);
}

TEST_F(FootReturnTest, RobotThatIsNoPlanarLegIsRefused) {
  EXPECT_THROW(run_foot_return(load_robot("pegasus"), "best", {}, {}, run_in_process), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
