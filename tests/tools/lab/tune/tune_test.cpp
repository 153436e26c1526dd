#include "tools/lab/tune/tune.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tools/lab/tune/tune_report.h"
#include "tools/lab/tune/tune_search.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Ge;
using testing::HasSubstr;
using testing::Le;

TEST(TunePlants, BeginWithTheNominalOneAndStayInTheirRanges) {
  const std::vector<SimOptions> plants = tune_plants(3, 40);
  ASSERT_EQ(plants.size(), 40u);
  EXPECT_TRUE(plants[0].plant.empty());
  for (std::size_t i = 1; i < plants.size(); ++i) {
    EXPECT_THAT(plants[i].plant.at("friction_scale"), AllOf(Ge(0.8), Le(1.2)));
    EXPECT_THAT(plants[i].plant.at("mass_scale"), AllOf(Ge(0.9), Le(1.1)));
    EXPECT_THAT(plants[i].plant.at("kt_scale"), AllOf(Ge(0.95), Le(1.05)));
    EXPECT_THAT(plants[i].plant.at("ground_stiffness"), AllOf(Ge(6000.0), Le(12000.0)));
    EXPECT_NE(plants[i].seed, plants[i - 1].seed);
  }
  EXPECT_EQ(tune_plants(3, 40)[7].plant, plants[7].plant);
  EXPECT_NE(tune_plants(4, 40)[7].plant, plants[7].plant);
  EXPECT_THROW(tune_plants(0, 0), std::invalid_argument);
}

class TuneTest : public testing::Test {
 protected:
  static TuneRequest small() {
    TuneRequest request;
    request.samples = 2;
    request.rounds = 1;
    request.plants = 1;
    return request;
  }
  TuneSpace space_{load_robot("single_leg"),
                   "best",
                   {{"hybrid_landing.stiffness.z", 400, 3000}, {"hybrid_landing.damping.z", 5, 120}}};
};

TEST_F(TuneTest, FindsTheCheapestAndReportsItOnOtherPlantsTheSameWhateverTheThreads) {
  TuneRequest request = small();
  std::size_t last = 0, total = 0;
  const TuneResult result = run_tune(space_, request, [&](std::size_t done, std::size_t count) {
    EXPECT_GT(done, last);
    last = done;
    total = count;
  });
  EXPECT_EQ(last, total);
  ASSERT_EQ(result.candidates.size(), 4u);  // present, two samples, one refined
  EXPECT_EQ(result.candidates[0].values, space_.present());
  for (const TuneCandidate& candidate : result.candidates)
    EXPECT_GE(candidate.cost, result.candidates[result.best].cost);
  EXPECT_EQ(result.best_reported.values, result.candidates[result.best].values);
  EXPECT_NE(result.present_reported.terms.landing_output_Nm, result.candidates[0].terms.landing_output_Nm);
  request.jobs = 1;
  const TuneResult again = run_tune(space_, request);
  for (std::size_t i = 0; i < result.candidates.size(); ++i)
    EXPECT_EQ(again.candidates[i].cost, result.candidates[i].cost) << i;
}

TEST_F(TuneTest, TheReportingSeedMustDifferFromTheTuningSeed) {
  TuneRequest request = small();
  request.seed = request.tune_seed;
  EXPECT_THROW(run_tune(space_, request), std::invalid_argument);
}

/// Made up: no simulation.
TuneResult tune_made_up() {
  TuneResult result;
  for (const double cost : {50.0, 30.0, 40.0}) {
    TuneCandidate candidate;
    candidate.values = {1500.0, cost};
    candidate.terms = {cost - 20.0, cost, cost + 5.0, 0.02, 1.0};
    candidate.cost = cost;
    result.candidates.push_back(candidate);
  }
  result.best = 1;
  result.present_reported = result.candidates[0];
  result.best_reported = result.candidates[1];
  return result;
}

TEST_F(TuneTest, TheTableStatesTheCostAndShowsTheBestFirst) {
  const std::string table = tune_table(space_, small(), tune_made_up());
  EXPECT_THAT(table, HasSubstr("Cost: mean peak of the knee's true gear output torque"));
  EXPECT_LT(table.find("#1"), table.find("#2"));
  EXPECT_THAT(table, HasSubstr("seed 1, which were not tuned on"));
}

TEST_F(TuneTest, RowsAndFragmentAreOfTheBest) {
  const std::vector<ReportRow> rows = tune_rows(space_, tune_made_up());
  EXPECT_EQ(rows[1].name, "tune.present.landing_output_torque");
  EXPECT_EQ(rows[1].value, 50.0);
  EXPECT_EQ(rows.back().name, "tune.best.hybrid_landing.damping.z");
  EXPECT_EQ(rows.back().value, 30.0);
  const std::string fragment = tune_fragment(space_, small(), tune_made_up(), "sprung experiment tune");
  EXPECT_THAT(fragment, AllOf(HasSubstr("z: 30 N s/m"), HasSubstr("cost 50 before, 30 with these")));
}

TEST_F(TuneTest, ThePageHasTheTradeAndAPlotForEachParameter) {
  const std::vector<report::Section> sections = tune_sections(space_, small(), tune_made_up());
  ASSERT_EQ(sections.size(), 4u);
  EXPECT_EQ(sections[2].plots.size(), 2u);
  EXPECT_EQ(sections[3].plots.size(), 2u);
  EXPECT_EQ(sections[2].plots[0].series[0].y, std::vector<double>{2.0})
      << "height error of the best, per cent";
  EXPECT_NO_THROW(report::to_html({"tune", "", "", sections}));
}

}  // namespace
}  // namespace sprung
