#include "estimator/identification/fit_warnings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace sprung::identification {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Case {
  std::vector<FitParameter> parameters{{"coulomb", "Nm", 1.0, 0.0}, {"offset", "Nm"}, {"gravity", "Nm"}};
  Fit fit;
  FitStatistics statistics;
  Case() {
    fit.parameters = Eigen::Vector3d(0.0, 2.0, 3.0);
    fit.at_bound.assign(3, false);
    fit.converged = true;
    statistics.standard_error = Eigen::Vector3d::Ones();
    statistics.correlation = Eigen::Matrix3d::Identity();
    statistics.effective_samples = 100.0;
  }
  std::vector<std::string> warnings(const std::vector<Eigen::VectorXd>& hidden = {}) const {
    return fit_warnings(parameters, fit, statistics, hidden);
  }
};

TEST(FitWarnings, AGoodFitHasNone) { EXPECT_THAT(Case().warnings(), IsEmpty()); }

TEST(FitWarnings, CorrelatedParametersAreBothNamedWithTheMotionThatSeparatesThem) {
  Case c;
  c.parameters[1].told_by = "both directions of motion";
  c.parameters[2].told_by = "a wider range of angles";
  c.statistics.correlation(1, 2) = c.statistics.correlation(2, 1) = -0.97;
  EXPECT_THAT(c.warnings(),
              ElementsAre(AllOf(HasSubstr("'offset' from 'gravity'"), HasSubstr("-0.970"),
                                HasSubstr("record both directions of motion, or a wider range"))));
  c.statistics.correlation(1, 2) = c.statistics.correlation(2, 1) = -0.94;
  EXPECT_THAT(c.warnings(), IsEmpty());
}

TEST(FitWarnings, HiddenDirectionNamesItsTwoLargestParameters) {
  EXPECT_THAT(Case().warnings({Eigen::Vector3d(0.7, 0.05, -0.71)}),
              ElementsAre(AllOf(HasSubstr("'coulomb' from 'gravity'"), HasSubstr("record motion that"))));
  EXPECT_THAT(Case().warnings({Eigen::Vector3d(0.0, 1.0, 0.0)}),
              ElementsAre(HasSubstr("nothing about 'offset'")));
}

TEST(FitWarnings, BoundsFewSamplesAndUnsettledSearchesAreSaid) {
  Case c;
  c.fit.at_bound[0] = true;
  c.fit.converged = false;
  c.statistics.effective_samples = 14.0;
  c.statistics.standard_error[2] = std::nan("");
  EXPECT_THAT(c.warnings(),
              ElementsAre(HasSubstr("'coulomb' ended on its bound 0 Nm"), HasSubstr("about 'gravity'"),
                          HasSubstr("only 14 independent"), HasSubstr("had settled")));
}

TEST(FitWarnings, FixedParametersAreNotWarnedOf) {
  Case c;
  c.parameters[0] = {"coulomb", "Nm", 1.0, 1.0, 1.0};
  c.fit.at_bound[0] = true;
  EXPECT_THAT(c.warnings(), IsEmpty());
}

}  // namespace
}  // namespace sprung::identification
