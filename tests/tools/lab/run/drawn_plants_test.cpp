#include "tools/lab/run/drawn_plants.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::HasSubstr;

double value_of(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& row : rows) {
    if (row.name == name) return row.value;
  }
  ADD_FAILURE() << "no row " << name;
  return kNaN;
}

const ReportRow& row_of(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& row : rows) {
    if (row.name == name) return row;
  }
  throw std::runtime_error("no row " + name);
}

/// Draw k says k; where `fails` is among them it throws.
Experiment counting(double fails = -1.0) {
  Experiment out;
  out.name = "count";
  out.takes = {Common::kPlant};
  out.run = [fails](const ExperimentInput& input) {
    const double draw = input.sim.plant.at("draw");
    if (draw == fails) throw std::runtime_error("it fell");
    return ExperimentOutput{{row("count.value", "Nm", draw, at_most(4.5))}, 1.0};
  };
  return out;
}

FinishedExperiment run(const Experiment& experiment, int plants, std::vector<std::string> changes = {}) {
  ExperimentRequest request;
  request.plants = plants;
  request.plant = std::move(changes);
  request.seed = 3;
  return run_experiment(experiment, experiment_input(experiment, request, load_robot("single_leg")));
}

TEST(DrawnPlants, AreNumberedFromOneOrFromTheDrawThatIsAsked) {
  SimOptions base;
  base.seed = 9;
  base.plant = {{"mass_scale", 1.1}};
  const std::vector<SimOptions> plants = drawn_plants(base, 3);
  ASSERT_EQ(plants.size(), 3U);
  EXPECT_EQ(plants[0].plant.at("draw"), 1.0);
  EXPECT_EQ(plants[2].plant.at("draw"), 3.0);
  EXPECT_EQ(plants[2].plant.at("mass_scale"), 1.1);
  EXPECT_EQ(plants[2].seed, 9U) << "the noise is the same";
  base.plant["draw"] = 101.0;
  EXPECT_EQ(drawn_plants(base, 2)[1].plant.at("draw"), 102.0);
  EXPECT_THROW(drawn_plants(base, 0), std::invalid_argument);
}

TEST(DrawnPlants, BoundedRowsHaveTheirWorstDraw) {
  const std::vector<ReportRow> rows = distribution_rows(
      {{11,
        {row("a", "Nm", 1.0, at_most(4.0)), row("b", "", 0.9, at_least(0.8)),
         row("c", "", 5.0, between(0, 9))},
        ""},
       {12,
        {row("a", "Nm", 5.0, at_most(4.0)), row("b", "", 0.7, at_least(0.8)),
         row("c", "", -1.0, between(0, 9))},
        ""},
       {13,
        {row("a", "Nm", 2.0, at_most(4.0)), row("b", "", 0.95, at_least(0.8)),
         row("c", "", 4.0, between(0, 9))},
        ""}});
  EXPECT_EQ(value_of(rows, "a.median"), 2.0);
  EXPECT_EQ(value_of(rows, "a.worst"), 5.0);
  EXPECT_EQ(value_of(rows, "a.worst_draw"), 12.0);
  EXPECT_FALSE(row_of(rows, "a.worst").ok());
  EXPECT_EQ(row_of(rows, "a.worst").unit, "Nm");
  EXPECT_TRUE(row_of(rows, "a.median").ok());
  EXPECT_EQ(value_of(rows, "b.worst"), 0.7);
  EXPECT_EQ(value_of(rows, "b.median"), 0.9);
  EXPECT_NEAR(value_of(rows, "b.met"), 200.0 / 3.0, 1e-9);
  EXPECT_EQ(value_of(rows, "c.worst"), -1.0);
}

TEST(DrawnPlants, RowsWithoutBoundsHaveBothEnds) {
  const std::vector<ReportRow> rows = distribution_rows(
      {{1, {row("a", "s", 3.0)}, ""}, {2, {row("a", "s", kNaN)}, ""}, {3, {row("a", "s", -3.0)}, ""}});
  EXPECT_EQ(value_of(rows, "a.least"), -3.0);
  EXPECT_EQ(value_of(rows, "a.least_draw"), 3.0);
  EXPECT_EQ(value_of(rows, "a.most"), 3.0);
  EXPECT_EQ(value_of(rows, "a.most_draw"), 1.0);
}

TEST(DrawnPlants, WhatWasNotReachedIsTheWorst) {
  const std::vector<ReportRow> rows = distribution_rows(
      {{1, {row("a", "s", 9.0, at_most(1.0))}, ""}, {2, {row("a", "s", kNaN, at_most(1.0))}, ""}});
  EXPECT_TRUE(std::isnan(value_of(rows, "a.worst")));
  EXPECT_EQ(value_of(rows, "a.worst_draw"), 2.0);
  EXPECT_FALSE(row_of(rows, "a.worst").ok());
}

TEST(DrawnPlants, ExperimentRunsOnEachAndSaysWhatWasVaried) {
  const FinishedExperiment finished = run(counting(), 4, {"family=erob_50"});
  EXPECT_EQ(value_of(finished.rows.rows, "count.plants.drawn"), 4.0);
  EXPECT_EQ(value_of(finished.rows.rows, "count.value.worst_draw"), 4.0);
  EXPECT_EQ(finished.rows.simulated_s, 4.0);
  EXPECT_TRUE(finished.ok());
  EXPECT_THAT(finished.command, HasSubstr("--plant family=erob_50 --plants 4"));
  EXPECT_THAT(finished.output.before,
              testing::AllOf(HasSubstr("Plants 1 to 4 of single_leg"), HasSubstr("of friction erob_50"),
                             HasSubstr("seed 3 on each")));
}

TEST(DrawnPlants, DrawWithoutRowsIsNamedAndNotOk) {
  const FinishedExperiment finished = run(counting(102.0), 3, {"draw=101"});
  EXPECT_EQ(value_of(finished.rows.rows, "count.plants.without_rows"), 1.0);
  EXPECT_FALSE(finished.ok());
  EXPECT_THAT(finished.output.before, HasSubstr("draw 102 has no rows: it fell"));
  EXPECT_THROW(run(counting(1.0), 1), std::runtime_error);
}

}  // namespace
}  // namespace sprung
