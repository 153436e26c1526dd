#include "tools/lab/friction/drag_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sprung {
namespace {

TEST(DragScore, FiguresOfAFewSamples) {
  const DragScore score = drag_score({{0.0, 10.0, 13.0, 4.0, 20.0}, {0.1, 10.0, 6.0, 2.0, 10.0}});
  EXPECT_EQ(score.samples, 2u);
  EXPECT_DOUBLE_EQ(score.rms_Nm, std::sqrt(12.5));
  EXPECT_DOUBLE_EQ(score.max_Nm, 4.0);
  EXPECT_DOUBLE_EQ(score.mean_Nm, -0.5);
  EXPECT_DOUBLE_EQ(score.coverage, 0.5);
  EXPECT_DOUBLE_EQ(score.half_width_Nm, 3.0);
  EXPECT_DOUBLE_EQ(score.paper_rms_Nm, std::sqrt(50.0));
  EXPECT_DOUBLE_EQ(score.reference_rms_Nm, 10.0);
}

TEST(DragScore, AnErrorOnTheBoundIsWithinIt) {
  EXPECT_EQ(drag_score({{0.0, 0.0, 2.0, 2.0, 0.0}}).coverage, 1.0);
}

TEST(DragScore, NothingAndNotANumberGiveNoFigure) {
  EXPECT_TRUE(std::isnan(drag_score({}).rms_Nm));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const DragScore lost = drag_score({{0.0, 1.0, nan, 1.0, 1.0}, {0.1, 1.0, 1.0, 1.0, 1.0}});
  EXPECT_TRUE(std::isnan(lost.rms_Nm));
  EXPECT_EQ(lost.coverage, 0.5);
}

TEST(DragScore, BetweenTwoCyclesInAStraightLine) {
  const DragSample middle = between({1.0, 0.0, 10.0, 2.0, 4.0}, {2.0, 4.0, 20.0, 4.0, 0.0}, 1.25);
  EXPECT_DOUBLE_EQ(middle.time_s, 1.25);
  EXPECT_DOUBLE_EQ(middle.reference_Nm, 1.0);
  EXPECT_DOUBLE_EQ(middle.estimate_Nm, 12.5);
  EXPECT_DOUBLE_EQ(middle.bound_Nm, 2.5);
  EXPECT_DOUBLE_EQ(middle.paper_Nm, 3.0);
}

}  // namespace
}  // namespace sprung
