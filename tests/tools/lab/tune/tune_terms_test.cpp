#include "tools/lab/tune/tune_terms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

using testing::ElementsAre;

JumpResult landed(double height_mm, double motor_Nm, double output_Nm) {
  JumpResult result;
  result.height_mm = height_mm;
  result.landing_knee_torque_Nm = motor_Nm;
  result.landing_knee_output_torque_Nm = output_Nm;
  result.upright = true;
  return result;
}

TEST(TuneTerms, AreMeansOverThePlants) {
  const TuneTerms terms = tune_terms({landed(220, 10, 40), landed(180, 20, 60)}, 200);
  EXPECT_DOUBLE_EQ(terms.landing_motor_Nm, 15.0);
  EXPECT_DOUBLE_EQ(terms.landing_output_Nm, 50.0);
  EXPECT_DOUBLE_EQ(terms.worst_landing_output_Nm, 60.0);
  EXPECT_DOUBLE_EQ(terms.height_error, 0.1);
  EXPECT_DOUBLE_EQ(terms.upright, 1.0);
}

TEST(TuneTerms, AJumpThatFellIsWrongByAllOfItsHeightAndNotUpright) {
  JumpResult fell = landed(200, 30, 80);
  fell.upright = false;
  const TuneTerms terms = tune_terms({landed(200, 10, 40), fell, JumpResult{}, JumpResult{}}, 200);
  EXPECT_DOUBLE_EQ(terms.upright, 0.25);
  EXPECT_DOUBLE_EQ(terms.height_error, 0.75);
  EXPECT_DOUBLE_EQ(terms.landing_output_Nm, 60.0) << "of those that were measured";
}

TEST(TuneCost, IsWhatItsTextSays) {
  const TuneTerms terms = tune_terms({landed(220, 10, 40)}, 200);  // 5 % beyond the free 5 %
  EXPECT_NEAR(tune_cost(terms, TuneObjective::kLandingOutput), 40.0 + 10.0, 1e-9);
  EXPECT_NEAR(tune_cost(terms, TuneObjective::kLandingMotor), 10.0 + 10.0, 1e-9);
  EXPECT_NEAR(tune_cost(terms, TuneObjective::kHeightError), 10.0, 1e-9);
  EXPECT_NEAR(tune_cost(terms, TuneObjective::kUpright), 4.0, 1e-9);
}

TEST(TuneCost, AFallNeverPays) {
  JumpResult fell = landed(200, 0.0, 0.0);
  fell.upright = false;
  for (const std::string& text : tune_objectives()) {
    const TuneObjective objective = tune_objective(text);
    EXPECT_GT(tune_cost(tune_terms({fell, landed(200, 0, 0)}, 200), objective),
              tune_cost(tune_terms({landed(200, 171, 171)}, 200), objective))
        << text;
    EXPECT_TRUE(std::isfinite(tune_cost(tune_terms({JumpResult{}}, 200), objective))) << text;
  }
}

TEST(TuneObjectives, AnUnknownOneIsRefused) { EXPECT_THROW(tune_objective("speed"), std::invalid_argument); }

TEST(ParetoFront, HoldsWhatNothingElseBeatsInEverything) {
  const std::vector<TuneTerms> all = {tune_terms({landed(200, 10, 50)}, 200),
                                      tune_terms({landed(200, 20, 40)}, 200),
                                      tune_terms({landed(200, 20, 50)}, 200),  // beaten by both
                                      tune_terms({landed(190, 9, 39)}, 200), tune_terms({JumpResult{}}, 200)};
  EXPECT_THAT(pareto_front(all), ElementsAre(0, 1, 3));
}

}  // namespace
}  // namespace sprung
