#include "tools/lab/run/experiment_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/tools/lab/run/experiment_index_sample.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(ExperimentIndex, HasALinkToEveryExperimentAndCountsItsDemands) {
  const std::string html = report::to_html(experiment_index(sample_heading(), sample_experiments()));
  EXPECT_THAT(html, AllOf(HasSubstr("<a href=\"jump.html\">jump</a>"), HasSubstr("1 of 2"),
                          HasSubstr("<a href=\"drop.html\">drop</a>"), HasSubstr("failed")));
  EXPECT_THAT(html, AllOf(HasSubstr("00000000000000ab"), HasSubstr("seed 7"),
                          HasSubstr("sprung experiment all --robot single_leg --seed 7")));
}

TEST(ExperimentIndex, ShowsEveryRowWithPaperRatioAndDemandAndEveryFigure) {
  const report::Report page = experiment_index(sample_heading(), sample_experiments());
  ASSERT_EQ(page.sections.size(), 4u);  // summary, rows of jump, its figures, drop
  const std::vector<report::Cell>& row = page.sections[1].tables[0].rows[0];
  EXPECT_EQ(row[0].text, "jump.hybrid.height");
  EXPECT_EQ(row[2].text, "188");
  EXPECT_EQ(row[3].text, "94");
  EXPECT_EQ(row[3].mark, report::Mark::kBad);
  EXPECT_EQ(row[4].text, "0.5");
  EXPECT_EQ(row[5].text, ">= 150");
  EXPECT_EQ(page.sections[1].tables[0].rows[1][3].mark, report::Mark::kGood);
  EXPECT_EQ(page.sections[1].tables[0].rows[2][3].mark, report::Mark::kPlain);
  EXPECT_EQ(page.sections[2].heading, "jump: Hybrid");
  EXPECT_EQ(page.sections[2].plots.size(), 1u);
  EXPECT_THAT(page.sections[3].text.back(), HasSubstr("the plant failed"));
}

TEST(ExperimentIndex, ThePageOfAnExperimentStandsAlone) {
  const report::Report page = experiment_page(sample_heading(), sample_experiments()[0]);
  EXPECT_EQ(page.command, "sprung experiment jump --robot single_leg --preset paper --seed 7");
  ASSERT_EQ(page.sections.size(), 2u);
  EXPECT_EQ(page.sections[1].heading, "Hybrid");
}

TEST(ExperimentIndex, JsonHoldsAllRowsAndWhatFailed) {
  const nlohmann::json json = nlohmann::json::parse(
      experiment_index_json(sample_heading(), sample_experiments()));
  EXPECT_EQ(json["robot_hash"], "00000000000000ab");
  EXPECT_EQ(json["ok"], false);
  ASSERT_EQ(json["experiments"].size(), 2u);
  EXPECT_EQ(json["experiments"][0]["experiment"], "jump");
  EXPECT_EQ(json["experiments"][0]["rows"].size(), 3u);
  EXPECT_TRUE(json["experiments"][0]["failure"].is_null());
  EXPECT_EQ(json["experiments"][1]["failure"], "the plant failed");
  EXPECT_EQ(json["experiments"][1]["ok"], false);
}

TEST(ExperimentIndex, TextHasALineForEach) {
  const std::string text = experiment_index_text(sample_experiments());
  EXPECT_THAT(text, AllOf(HasSubstr("1 of 2 demands met"), HasSubstr("FAILED: the plant failed")));
}

}  // namespace
}  // namespace sprung
