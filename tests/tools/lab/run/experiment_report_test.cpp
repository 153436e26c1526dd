#include "tools/lab/run/experiment_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace sprung {
namespace {

ReportRow bounded(double value) { return {"jump.hybrid.height", "mm", value, 188.0, 150.0, 210.0}; }

TEST(ReportRow, RowWithoutBoundsIsAlwaysOk) {
  EXPECT_TRUE((ReportRow{"a", "mm", std::numeric_limits<double>::quiet_NaN(), {}, {}, {}}.ok()));
}

TEST(ReportRow, BoundsAreInclusive) {
  EXPECT_TRUE(bounded(150.0).ok());
  EXPECT_TRUE(bounded(210.0).ok());
  EXPECT_FALSE(bounded(149.9).ok());
  EXPECT_FALSE(bounded(210.1).ok());
}

TEST(ReportRow, WhatWasNotReachedIsNotOk) {
  EXPECT_FALSE(bounded(std::numeric_limits<double>::quiet_NaN()).ok());
}

TEST(ExperimentReport, JsonHoldsTheAgreedKeys) {
  ExperimentReport report;
  report.experiment = "jump";
  report.robot = "single_leg";
  report.seed = 7;
  report.rows = {bounded(187.2),
                 {"jump.hybrid.x", "mm", std::numeric_limits<double>::quiet_NaN(), {}, {}, {}}};
  const auto json = nlohmann::json::parse(report.json());
  EXPECT_EQ(json["experiment"], "jump");
  EXPECT_EQ(json["seed"], 7);
  EXPECT_EQ(json["rows"][0]["name"], "jump.hybrid.height");
  EXPECT_EQ(json["rows"][0]["value"], 187.2);
  EXPECT_EQ(json["rows"][0]["paper"], 188.0);
  EXPECT_EQ(json["rows"][0]["ok"], true);
  EXPECT_TRUE(json["rows"][1]["value"].is_null());
  EXPECT_TRUE(json["rows"][1]["low"].is_null());
}

TEST(Row, HoldsWhatItIsHeldAgainst) {
  const ReportRow plain = row("a.b", "mm", 2.0);
  EXPECT_FALSE(plain.low || plain.high || plain.paper);
  EXPECT_EQ(row("a", "", 2.0, at_most(3.0)).high, 3.0);
  EXPECT_FALSE(row("a", "", 2.0, at_most(3.0)).low);
  EXPECT_EQ(row("a", "", 2.0, at_least(1.0)).low, 1.0);
  const ReportRow both = row("a", "", 2.0, between(1.0, 3.0));
  EXPECT_EQ(both.low, 1.0);
  EXPECT_EQ(both.high, 3.0);
  EXPECT_EQ(row("a", "", 2.0, {{}, {}, 4.75}).paper, 4.75);
  EXPECT_TRUE(row("a", "", 9.0, demanded(false, at_most(3.0))).ok());
  EXPECT_FALSE(row("a", "", 9.0, demanded(true, at_most(3.0))).ok());
}

TEST(ExperimentReport, OneBadRowMakesItBad) {
  ExperimentReport report;
  report.rows = {bounded(187.2)};
  EXPECT_TRUE(report.ok());
  report.rows.push_back(bounded(20.0));
  EXPECT_FALSE(report.ok());
  EXPECT_THAT(report.table(), testing::HasSubstr("NOT OK"));
}

TEST(ExperimentReport, HeadlineOfABenchmarkNamesNoRobotThatItDoesNotHave) {
  ExperimentReport report;
  report.experiment = "mac";
  EXPECT_THAT(report.table(), testing::StartsWith("mac: 0.0 s simulated"));
  report.robot = "pegasus";
  report.preset = "nominal";
  EXPECT_THAT(report.table(), testing::StartsWith("mac on pegasus, preset nominal, seed 0: 0.0 s simulated"));
}

TEST(ReportRow, ExcessIsHowFarItLiesBeyondItsBounds) {
  EXPECT_DOUBLE_EQ(row("a", "", 3.0, at_most(2.0)).excess(), 1.0);
  EXPECT_DOUBLE_EQ(row("a", "", 3.0, between(0.0, 4.0)).excess(), -1.0);
  EXPECT_EQ(row("a", "", std::nan(""), at_most(2.0)).excess(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(row("a", "", 3.0).excess(), -std::numeric_limits<double>::infinity());
}

TEST(ReportRows, ReadBackToTheBit) {
  const std::vector<ReportRow> rows = {row("a", "mm", 0.1 + 0.2, {1.0, {}, 184.0}),
                                       row("b", "", std::nan(""))};
  const auto read = rows_of_json(rows_json(rows));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].value, 0.1 + 0.2);
  EXPECT_EQ(read[0].paper, 184.0);
  EXPECT_EQ(read[0].low, 1.0);
  EXPECT_FALSE(read[0].high);
  EXPECT_TRUE(std::isnan(read[1].value));
}

}  // namespace
}  // namespace sprung
