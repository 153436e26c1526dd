#include "tools/lab/study/study_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

using testing::HasSubstr;
using testing::Not;

StudyResult result(std::int64_t number, double value, const std::string& failure = "") {
  StudyResult out;
  out.number = out.run.number = number;
  out.run.seed = 3;
  out.run.plant = {"draw=1", "family=coulomb"};
  out.run.parameters = {{"presets.best.x", 0.5 * static_cast<double>(number)}};
  out.command = "sprung experiment jump --seed " + std::to_string(number);
  out.failure = failure;
  if (failure.empty()) out.rows = {row("a.height", "mm", value, at_least(10.0)), row("a.free", "", 1.0)};
  return out;
}

StudyTable table() {
  return study_table({result(2, 8.0), result(1, 20.0), result(3, 0.0, "fell, \"hard\"")});
}

StudyState state() { return {"sample", {"0.1", "ab"}, 5, {4, 5}, {{4, "too late"}}, "sprung study run it"}; }

TEST(StudyTable, CsvHasARowARunWithUnitsAndQuotes) {
  EXPECT_EQ(csv_of(table()),
            "run,seed,plant,presets.best.x,failure,a.height (mm),a.free\n"
            "1,3,draw=1 family=coulomb,0.5,,20,1\n"
            "2,3,draw=1 family=coulomb,1,,8,1\n"
            "3,3,draw=1 family=coulomb,1.5,\"fell, \"\"hard\"\"\",,\n");
}

TEST(StudyTable, SummarySaysWhatIsMissingAndWhy) {
  EXPECT_EQ(summary_of(table(), state()),
            "3 of 5 runs, 1 of them failed; missing: 4,5; 4: too late; go on with: sprung study run it");
  StudyState whole = state();
  whole.missing.clear();
  EXPECT_EQ(summary_of(table(), whole), "3 of 5 runs, 1 of them failed");
}

TEST(StudyTable, PageNamesTheWorstRunAndTheLineThatRepeatsIt) {
  const std::string html = report::to_html(study_page(table(), state(), {}));
  EXPECT_THAT(html, HasSubstr("sprung experiment jump --seed 2"));
  EXPECT_THAT(html, HasSubstr("missing: 4,5"));
  EXPECT_THAT(html, HasSubstr("By presets.best.x"));
}

TEST(StudyTable, PageDrawsTheRowsThatAreAskedFor) {
  const report::Report page = study_page(table(), state(), {"a.free"});
  ASSERT_EQ(page.sections.size(), 2u);
  ASSERT_EQ(page.sections[1].plots.size(), 1u);
  EXPECT_EQ(page.sections[1].plots[0].title, "a.free");
  EXPECT_EQ(page.sections[1].plots[0].series[0].x, (std::vector<double>{0.5, 1.0}));
}

TEST(StudyTable, ValuesThatWereNotReachedAreTheWorst) {
  const StudyTable some = study_table({result(1, 20.0), result(2, std::nan("")), result(3, 5.0)});
  const std::string html = report::to_html(study_page(some, state(), {}));
  EXPECT_THAT(html, HasSubstr("sprung experiment jump --seed 2"));
  EXPECT_THAT(html, Not(HasSubstr("sprung experiment jump --seed 3")));
}

TEST(StudyTable, OfNoRunsIsEmpty) {
  EXPECT_EQ(csv_of(study_table({})), "run,seed,plant,failure\n");
  EXPECT_FALSE(report::to_html(study_page(study_table({}), state(), {})).empty());
}

}  // namespace
}  // namespace sprung
