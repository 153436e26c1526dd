#include "tools/lab/gait/endurance.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "robots/gait_speed.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const RobotConfig& pegasus() {
  static const RobotConfig robot = load_robot("pegasus");
  return robot;
}

const ReportRow& endurance_row(const std::vector<ReportRow>& rows, const std::string& quantity) {
  for (const ReportRow& row : rows)
    if (row.name == "endurance.all." + quantity) return row;
  throw std::out_of_range(quantity);
}

TEST(EnduranceScript, TheSameSeedAsksTheSameAndAnotherAsksElse) {
  const auto one = endurance_script(pegasus(), "best", 3, 60.0);
  const auto again = endurance_script(pegasus(), "best", 3, 60.0);
  const auto other = endurance_script(pegasus(), "best", 4, 60.0);
  ASSERT_EQ(one.size(), again.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].command.walk_speed, again[i].command.walk_speed);
    EXPECT_EQ(one[i].lasts_s, again[i].lasts_s);
  }
  EXPECT_NE(one[0].command.walk_speed, other[0].command.walk_speed);
}

TEST(EnduranceScript, ItLastsAsLongAsAsked) {
  double sum_s = 0.0;
  for (const EnduranceStep& step : endurance_script(pegasus(), "best", 1, 600.0)) sum_s += step.lasts_s;
  EXPECT_NEAR(sum_s, 600.0, 1e-9);
}

TEST(EnduranceScript, EverythingIsAskedForAndOnlyWhatIsAllowed) {
  std::set<int> gaits;
  int stops = 0, now = -1;
  for (const EnduranceStep& step : endurance_script(pegasus(), "best", 2, 3600.0)) {
    if (step.command.kind == OperatorKind::kStop) {
      ++stops;
      now = -1;
      continue;
    }
    const GaitConfig& gait = pegasus().gaits[step.command.gait];
    EXPECT_LE(step.command.walk_speed[0], gait.fastest_forward_m_s);
    EXPECT_GE(step.command.walk_speed[0], -gait.fastest_backward_m_s);
    EXPECT_LE(std::abs(step.command.walk_speed[1]), gait.fastest_sideways_m_s);
    EXPECT_LE(std::abs(step.command.walk_speed[2]), gait.fastest_turning_rad_s);
    EXPECT_LE(speed_share(gait, step.command.walk_speed), kMostSpeedShare);
    if (now >= 0 && now != step.command.gait) {
      const auto& to = pegasus().gaits[now].to;
      EXPECT_NE(std::find(to.begin(), to.end(), gait.name), to.end()) << gait.name;
    }
    gaits.insert(now = step.command.gait);
  }
  EXPECT_EQ(gaits.size(), pegasus().gaits.size());
  EXPECT_GT(stops, 10);
}

TEST(EndurancePlants, AreDrawnWithinWhatTheIssueAsksFor) {
  double least = 1.0, most = 0.4;
  for (std::uint64_t number = 0; number < 50; ++number) {
    const auto plant = endurance_plant(number);
    EXPECT_NEAR(plant.at("friction_scale"), 1.0, 0.2);
    EXPECT_NEAR(plant.at("mass_scale"), 1.0, 0.1);
    least = std::min(least, plant.at("ground_friction"));
    most = std::max(most, plant.at("ground_friction"));
  }
  EXPECT_NEAR(least, 0.4, 0.05);
  EXPECT_NEAR(most, 1.0, 0.05);
}

TEST(EndurancePlants, ASeedChangesNoiseAndRequestsAndAnEnsembleThePlants) {
  EnduranceRequest request;
  request.minutes = 0.02;
  const EnduranceOutcome one = endure(pegasus(), request, 0);
  request.seed = 5;
  EXPECT_EQ(endure(pegasus(), request, 0).plant, one.plant);
  EXPECT_NE(endure(pegasus(), request, 1).plant, one.plant);
  request.ensemble = 2;
  EXPECT_NE(endure(pegasus(), request, 0).plant, one.plant);
}

TEST(EnduranceRows, FallsAndTripsAreNotAllowed) {
  std::vector<EnduranceOutcome> outcomes(3);
  EXPECT_TRUE(endurance_row(endurance_rows(outcomes), "falls").ok());
  outcomes[1].vitals.fell = true;
  outcomes[2].vitals.trips = 2;
  const auto rows = endurance_rows(outcomes);
  EXPECT_EQ(endurance_row(rows, "falls").value, 1.0);
  EXPECT_EQ(endurance_row(rows, "limit_trips").value, 2.0);
  EXPECT_EQ(endurance_row(rows, "uncaught_falls").value, 1.0);
  EXPECT_FALSE(endurance_row(rows, "falls").ok());
  EXPECT_FALSE(endurance_row(rows, "limit_trips").ok());
}

TEST(EnduranceRows, InWorldsOneFallIsBorne) {
  std::vector<EnduranceOutcome> outcomes(3);
  outcomes[1].vitals.fell = true;
  outcomes[1].vitals.caught = true;
  const auto well = [&] {
    bool ok = true;
    for (const ReportRow& row : endurance_rows(outcomes, true)) {
      EXPECT_EQ(row.name.rfind("endurance.worlds.", 0), 0u) << row.name;
      ok = ok && row.ok();
    }
    return ok;
  };
  EXPECT_TRUE(well());
  outcomes[2].vitals.fell = true;
  EXPECT_FALSE(well());
  outcomes[2].vitals.fell = outcomes[1].vitals.caught = false;
  EXPECT_FALSE(well()) << "it was not noticed";
}

TEST(EndurancePlants, WorldsAreDrawnBesidesThemAndWhatIsAskedForCounts) {
  EnduranceRequest request;
  request.minutes = 0.02;
  request.worlds = true;
  EXPECT_GT(endure(pegasus(), request, 0).plant.count("ground_begins"), 0u);
  request.plant = {{"ground_begins", 1.5}};
  EXPECT_EQ(endure(pegasus(), request, 0).plant.at("ground_begins"), 1.5);
}

TEST(EnduranceRows, WorstOfAllSeedsAndTheSumOfTheirTime) {
  std::vector<EnduranceOutcome> outcomes(2);
  outcomes[0].vitals.watched_s = 30.0;
  outcomes[1].vitals.watched_s = 60.0;
  outcomes[0].vitals.saturated_share = 0.01;
  outcomes[0].simulated_s = outcomes[1].simulated_s = 50.0;
  outcomes[0].processor_s = outcomes[1].processor_s = 5.0;
  EXPECT_NEAR(endurance_row(endurance_rows(outcomes), "watched").value, 1.5, 1e-12);
  EXPECT_NEAR(endurance_row(endurance_rows(outcomes), "saturated_worst").value, 1.0, 1e-12);
  EXPECT_NEAR(endurance_speed(outcomes), 10.0, 1e-12);
}

TEST(Endurance, AFewSecondsOnTwoPlantsAreTheSameBitsOnOneThreadAndOnTwo) {
  EnduranceRequest request;
  request.seed = 1;
  request.seeds = 2;
  request.minutes = 0.05;
  request.parallel.jobs = 1;
  const auto one = run_endurance(pegasus(), request);
  request.parallel.jobs = 2;
  const auto two = run_endurance(pegasus(), request);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_FALSE(one[i].vitals.fell) << one[i].vitals.why << ", " << one[i].doing;
    EXPECT_EQ(one[i].vitals.trips, 0) << one[i].vitals.why << ", " << one[i].doing;
    EXPECT_GT(one[i].vitals.watched_s, 2.9);
    EXPECT_GT(one[i].vitals.strongest_Nm, 1.0);
    EXPECT_EQ(one[i].vitals.strongest_Nm, two[i].vitals.strongest_Nm);
    EXPECT_EQ(one[i].vitals.fastest_rad_s, two[i].vitals.fastest_rad_s);
  }
}

TEST(Endurance, WhatCannotBeAskedIsRefused) {
  EnduranceRequest request;
  request.seeds = 0;
  EXPECT_THROW(run_endurance(pegasus(), request), std::invalid_argument);
  request.seeds = 1;
  request.minutes = 0.0;
  EXPECT_THROW(run_endurance(pegasus(), request), std::invalid_argument);
}

TEST(EnduranceSection, NamesWhatBefellARobotAndWhatItWasAskedThen) {
  EnduranceOutcome out;
  out.plant = endurance_plant(1);
  EXPECT_EQ(endurance_section({out}).tables.at(0).rows.at(0).back().text, "nothing");
  out.vitals.fell = true;
  out.vitals.why = "fell: tilted";
  out.doing = "trot 0.40";
  EXPECT_THAT(endurance_section({out}).tables.at(0).rows.at(0).back().text,
              AllOf(HasSubstr("tilted"), HasSubstr("trot 0.40")));
}

}  // namespace
}  // namespace sprung
