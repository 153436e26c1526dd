#include "tools/logs/replay/difference_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace sprung {
namespace {

using testing::HasSubstr;
using testing::Not;

ReplayResult result_of(std::int64_t compared) {
  ReplayResult result;
  result.robot = "single_leg";
  result.clock = "lockstep";
  result.source = "robot.yaml in the log, preset best";
  result.counts.compared = compared;
  result.counts.first_seq = 0;
  result.counts.last_seq = 999;
  result.replayed_s = 1.0;
  result.wall_s = 0.01;
  result.differences = DifferenceTable(true);
  return result;
}

ReplayResult differing() {
  ReplayResult result = result_of(4000);
  result.counts.differing = 3;
  for (int k = 0; k < 3; ++k)
    result.differences.add("JOINT_STATE", 5 + k, 0.005 + 0.001 * k,
                           {{"joints[1].gear_output_torque_Nm", "Nm", "1.5", "1.75", 0.25},
                            {"joints[1].status", "", "ok (0)", "stale (1)", 1.0}});
  return result;
}

ReplayRequest request() {
  ReplayRequest request;
  request.log = "x.lcm";
  return request;
}

TEST(ReplayText, SaysIdenticalInALineOfItsOwn) {
  const std::string text = replay_text(request(), result_of(4000));
  EXPECT_THAT(text, HasSubstr("\nidentical\n"));
  EXPECT_THAT(text, HasSubstr("x.lcm: single_leg, lockstep, robot.yaml in the log, preset best"));
  EXPECT_THAT(text, HasSubstr("estimator, planner, controller: cycles 0 to 999, 4000 messages compared"));
  EXPECT_THAT(text, HasSubstr("100 x real time"));
}

TEST(ReplayText, LongNamesAreNotCutOff) {
  ReplayRequest long_name = request();
  long_name.log = std::string(600, 'x') + ".lcm";
  EXPECT_THAT(replay_text(long_name, result_of(1)),
              HasSubstr("x.lcm: single_leg, lockstep, robot.yaml in the log, preset best\n"));
}

TEST(ReplayJson, TextThatIsNoUtf8DoesNotEndIt) {
  ReplayResult result = result_of(1);
  result.differences.add("SAFETY_STATE", 1, 0.0, {{"detail", "", "\xff", "a", 0.0}});
  const nlohmann::json json = nlohmann::json::parse(replay_json(request(), result));
  EXPECT_EQ(json["first_difference"]["replayed"], "a");
}

TEST(ReplayText, MessagesThatWereLeftOutAreTold) {
  ReplayResult result = result_of(1);
  result.flaws.foreign = 3;
  EXPECT_THAT(replay_text(request(), result), HasSubstr("note: 3 messages are none"));
}

TEST(ReplayText, NamesTimeFieldAndBothValuesOfTheFirstDifference) {
  const std::string text = replay_text(request(), differing());
  EXPECT_THAT(text,
              HasSubstr("first difference: JOINT_STATE cycle 5 (0.005000 s): joints[1].gear_output_torque_Nm "
                        "1.5 Nm in the log, 1.75 Nm now\n"));
  EXPECT_THAT(text, HasSubstr("3 messages from 0.005 s on, largest 0.25 Nm"));
  EXPECT_THAT(text, Not(HasSubstr("identical")));
}

TEST(ReplayText, NamesTheMessageOfAnotherVersionAndThatVersion) {
  ReplayResult result = result_of(4000);
  result.version = "0.1.0 db8463133b9f";
  result.counts.other_version = 1000;
  result.counts.first_other_version = "JOINT_STATE";
  const std::string text = replay_text(request(), result);
  EXPECT_THAT(text, HasSubstr("note: the log's JOINT_STATE is a message of another version of sprung "
                              "(0.1.0 db8463133b9f): 1000 messages were not compared"));
  EXPECT_THAT(text, HasSubstr("\nidentical, where the log can be compared\n"));
  EXPECT_FALSE(result.identical());
}

TEST(ReplayText, NotesWhatMakesTheVerdictWeaker) {
  ReplayResult result = result_of(100);
  result.counts.first_seq = 500;
  result.counts.incomplete = 2;
  result.counts.first_incomplete = "cycle 600: the estimator had IMU 599, which is not in the log";
  result.flaws.unanswered = 1;
  result.flaws.late = 4;
  result.damages = 1;
  const std::string text = replay_text(request(), result);
  EXPECT_THAT(text, HasSubstr("begins with cycle 500"));
  EXPECT_THAT(text, HasSubstr("2 inputs are missing, first cycle 600"));
  EXPECT_THAT(text, HasSubstr("1 commands of the operator"));
  EXPECT_THAT(text, HasSubstr("4 messages came too late"));
  EXPECT_THAT(text, HasSubstr("damaged"));
  EXPECT_THAT(text, HasSubstr("identical, where the log has the inputs"));
}

/// Cycle 5 to 7 from older messages, LEG_COMMAND 4 to 6 never made.
ReplayResult not_deterministic() {
  ReplayResult result = result_of(4000);
  result.lockstep.older.add(5, 7);
  result.lockstep.absent[1].never_made.add(4, 6);
  return result;
}

TEST(ReplayText, NamesCyclesThatNeverExisted) {
  const std::string text = replay_text(request(), not_deterministic());
  EXPECT_THAT(
      text, HasSubstr("note: not deterministic: 3 cycles made from older messages than their own: 5 to 7\n"));
  EXPECT_THAT(text, HasSubstr("note: not deterministic: LEG_COMMAND of 3 cycles never existed: 4 to 6\n"));
  EXPECT_THAT(text, HasSubstr("\nidentical, where the log has the messages\n"));
}

TEST(ReplayText, NamesMessagesThatTheLogLacks) {
  ReplayResult result = result_of(4000);
  result.lockstep.absent[0].not_in_log.add(7);
  const std::string text = replay_text(request(), result);
  EXPECT_THAT(text, HasSubstr("note: JOINT_STATE of 1 cycle is not in the log, lost or never made: 7\n"));
  EXPECT_THAT(text, HasSubstr("\nidentical, where the log has the messages\n"));
}

TEST(ReplayText, WholeLogOfARunThatWasNotDeterministicIsNotJustIdentical) {
  ReplayResult result = result_of(4000);
  result.lockstep.older.add(5);
  EXPECT_TRUE(result.identical());
  EXPECT_THAT(replay_text(request(), result),
              HasSubstr("\nidentical, of a run that was not deterministic\n"));
}

/// The log is whole, but the bridge, or the simulated drives, did not wait.
TEST(ReplayText, NamesTheCyclesInWhichTheBridgeHadNoAnswer) {
  ReplayResult result = result_of(4000);
  result.lockstep.without_answer.add(1002, 1326);
  const std::string text = replay_text(request(), result);
  EXPECT_THAT(text, HasSubstr("note: not deterministic: the bridge went on without an answer in 325 cycles: "
                              "1002 to 1326\n"));
  EXPECT_THAT(text, HasSubstr("\nidentical, of a run that was not deterministic\n"));
  const auto json = nlohmann::json::parse(replay_json(request(), result));
  EXPECT_EQ(json["without_answer"]["cycles"], 325);
  EXPECT_FALSE(json["deterministic"]);
}

TEST(ReplayText, NamesWhatProcessesSayOfARunThatWasNotDeterministic) {
  ReplayResult result = result_of(4000);
  result.flaws.said = {"sprung-sim-drives: no SYNC"};
  const std::string text = replay_text(request(), result);
  EXPECT_THAT(text, HasSubstr("note: not deterministic: sprung-sim-drives: no SYNC\n"));
  EXPECT_THAT(text, HasSubstr("\nidentical, of a run that was not deterministic\n"));
}

TEST(ReplayJson, HasTheCyclesThatNeverExisted) {
  const auto json = nlohmann::json::parse(replay_json(request(), not_deterministic()));
  EXPECT_FALSE(json["identical"]);
  EXPECT_EQ(json["made_from_older"],
            nlohmann::json::parse(R"({"cycles": 3, "stretches": 1, "first_stretches": [[5, 7]]})"));
  EXPECT_EQ(json["never_existed"]["LEG_COMMAND"]["first_stretches"], nlohmann::json::parse("[[4, 6]]"));
  EXPECT_TRUE(json["not_in_log"].empty());
  EXPECT_EQ(json["notes"].size(), 2u);
}

TEST(ReplayText, NothingComparedIsNotIdentical) {
  EXPECT_THAT(replay_text(request(), result_of(0)), HasSubstr("nothing to compare"));
}

TEST(ReplayJson, HasTheFirstDifferenceForScripts) {
  const auto json = nlohmann::json::parse(replay_json(request(), differing()));
  EXPECT_FALSE(json["identical"]);
  EXPECT_EQ(json["first_difference"]["field"], "joints[1].gear_output_torque_Nm");
  EXPECT_EQ(json["first_difference"]["seq"], 5);
  const auto same = nlohmann::json::parse(replay_json(request(), result_of(10)));
  EXPECT_TRUE(same["identical"]);
  EXPECT_TRUE(same["first_difference"].is_null());
}

TEST(ReplayPage, HasTableAndPlotsOfTheDifferences) {
  const report::Report page = replay_page(request(), differing(), "sprung replay x.lcm");
  const std::string html = report::to_html(page);
  EXPECT_THAT(html, HasSubstr("joints[1].gear_output_torque_Nm"));
  ASSERT_EQ(page.sections.size(), 3u);
  EXPECT_EQ(page.sections[1].tables[0].rows.size(), 2u);
  EXPECT_EQ(page.sections[2].plots.size(), 2u);
  EXPECT_EQ(page.sections[2].plots[0].series[0].x.size(), 3u);
  EXPECT_EQ(replay_page(request(), result_of(10), "").sections.size(), 1u);
}

TEST(DiffText, SaysWhatIsInWhichLog) {
  DiffResult result;
  result.channels["IMU"] = {100, 0, 2, 0};
  result.metadata = {"preset: best and paper"};
  DiffRequest request;
  request.first = "a.lcm";
  request.second = "b.lcm";
  const std::string text = diff_text(request, result);
  EXPECT_THAT(text, HasSubstr("note: preset: best and paper"));
  EXPECT_THAT(text, HasSubstr("100 in both, 0 differ, 2 in the first only"));
  EXPECT_THAT(text, Not(HasSubstr("identical")));
  result.channels["IMU"].only_first = 0;
  EXPECT_THAT(diff_text(request, result), HasSubstr("identical\n"));
  EXPECT_THAT(diff_text(request, DiffResult()), HasSubstr("nothing to compare"));
}

TEST(DiffPage, HasTheChannels) {
  DiffResult result;
  result.channels["IMU"] = {100, 1, 0, 0};
  result.differences = DifferenceTable(true);
  result.differences.add("IMU", 1, 0.1, {{"x", "m", "1", "2", 1.0}});
  const report::Report page = diff_page({}, result, "");
  EXPECT_EQ(page.sections[0].tables[0].rows.size(), 1u);
  EXPECT_THAT(report::to_html(page), HasSubstr("in the second minus in the first"));
}

}  // namespace
}  // namespace sprung
