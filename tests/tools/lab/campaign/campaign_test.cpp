#include "tools/lab/campaign/campaign.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung::campaign {
namespace {

using testing::HasSubstr;

double value_of(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& row : rows)
    if (row.name == "campaign." + name) return row.value;
  ADD_FAILURE() << "no row " << name;
  return kNaN;
}

class CampaignTest : public testing::Test {
 protected:
  /// Ten runs that went well, with their twins.
  CampaignTest() {
    for (std::uint64_t i = 0; i < 10; ++i) {
      Verdict good;
      good.draw = draw_run(robot_, 3, i, Class::kDrive);
      good.recovered = true;
      result_.runs.push_back(good);
      result_.twins.push_back(good);
    }
  }
  const RobotConfig robot_ = load_robot("single_leg");
  Result result_;
};

TEST_F(CampaignTest, RunsThatWentWellAreWithinAllBounds) {
  EXPECT_TRUE(all_ok(campaign_rows(result_)));
  EXPECT_DOUBLE_EQ(value_of(campaign_rows(result_), "all.less_than_at_95_percent"), 30.0);
}

TEST_F(CampaignTest, WithoutTwinsThereAreTheSameRuns) {
  Request request;
  request.runs = 1;
  request.only = Class::kBus;
  const Result with = run_campaign(robot_, request);
  request.twins = false;
  const Result without = run_campaign(robot_, request);
  ASSERT_EQ(with.twins.size(), 1U);
  EXPECT_TRUE(without.twins.empty());
  ASSERT_EQ(without.runs.size(), 1U);
  EXPECT_EQ(without.runs[0].cause, with.runs[0].cause);
  EXPECT_EQ(without.runs[0].simulated_s, with.runs[0].simulated_s);
}

TEST_F(CampaignTest, EachBreachCountsInItsRow) {
  for (const auto& word : kWords<Rule>) {
    Result one = result_;
    one.runs[4].breaches = {{word.value, 12, "knee"}};
    const auto rows = campaign_rows(one);
    EXPECT_EQ(value_of(rows, std::string("all.") + word.name), 1.0);
    EXPECT_FALSE(all_ok(rows)) << word.name;
  }
}

TEST_F(CampaignTest, WrongCausesLostRobotsAndFalseStopsAreNotOk) {
  Result one = result_;
  one.runs[0].cause_expected = false;
  EXPECT_EQ(value_of(campaign_rows(one), "all.causes_right"), 90.0);
  one = result_;
  one.runs[0].recovered = false;
  EXPECT_FALSE(all_ok(campaign_rows(one)));
  one.runs[0].explained = "lies on its back";
  EXPECT_TRUE(all_ok(campaign_rows(one)));
  one = result_;
  one.twins[9].cause = SafetyCause::kImplausible;
  EXPECT_EQ(value_of(campaign_rows(one), "none.false_stops"), 1.0);
  EXPECT_FALSE(all_ok(campaign_rows(one)));
  one = result_;
  one.twins[3].breaches = {{Rule::kTooFast, 5, "knee"}};
  EXPECT_EQ(value_of(campaign_rows(one), "none.false_stops"), 1.0)
      << "a rule broken without a fault counts too";
  one = result_;
  one.runs[2].failure = "the plant failed";
  EXPECT_FALSE(all_ok(campaign_rows(one)));
}

TEST_F(CampaignTest, BadRunIsRepeatedByThePrintedCommand) {
  Verdict& verdict = result_.runs[7];
  verdict.breaches = {{Rule::kTooFast, 99, "knee 1.5 times"}};
  const std::string text = failure_text(verdict, robot_, "my/leg");
  EXPECT_THAT(text, HasSubstr("too_fast: knee 1.5 times in cycle 99"));
  EXPECT_THAT(text, HasSubstr("sprung campaign --robot my/leg --seed 3 --first 7 --runs 1 --only drive"))
      << "as it was asked for; and what is drawn depends on the class";
}

TEST_F(CampaignTest, SameSeedGivesTheSameRowsWhateverTheThreads) {
  Request request;
  request.runs = 3;
  request.seed = 2;
  request.parallel.jobs = 1;
  const auto one = campaign_rows(run_campaign(robot_, request));
  request.parallel.jobs = 2;
  const auto two = campaign_rows(run_campaign(robot_, request));
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].value, two[i].value) << one[i].name;
  request.runs = 0;
  EXPECT_THROW(run_campaign(robot_, request), std::invalid_argument);
}

TEST_F(CampaignTest, PageHasGroupsAndEveryBadRun) {
  result_.runs[7].breaches = {{Rule::kTooFast, 99, "knee"}};
  const auto sections = campaign_sections(result_, robot_, "single_leg");
  ASSERT_EQ(sections.size(), 2u);
  EXPECT_EQ(sections[0].tables.size(), 3u);
  ASSERT_EQ(sections[0].plots.size(), 2u);
  for (const report::Plot& plot : sections[0].plots)
    for (const report::Series& series : plot.series) EXPECT_EQ(series.y.back(), 100.0) << series.name;
  EXPECT_EQ(sections[1].text.size(), 1u);
}

}  // namespace
}  // namespace sprung::campaign
