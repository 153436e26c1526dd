#include "tools/lab/gait/stand_push_score.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace sprung {
namespace {

/// Two joints of -12 and 3 Nm; from 0 to 0.1 s they carry what is added; one foot, moved by `off_m` in the
/// end.
std::vector<PushSample> samples(double first_Nm, double second_Nm, Vec3 off_m = {}) {
  std::vector<PushSample> out;
  for (int k = -500; k < 1000; ++k) {
    const bool pushed = k >= 0 && k < 50;
    const bool late = k > 600;
    PushSample s;
    s.time_s = 0.002 * k;
    s.gear_output_Nm = {-12.0 + (pushed ? first_Nm : 0.0), 3.0 + (pushed ? second_Nm : 0.0)};
    s.motor_side_Nm = {0.5 * s.gear_output_Nm[0], 0.5 * s.gear_output_Nm[1]};
    s.foot_in_trunk_m = {{0.3, 0.2, -0.5}};
    for (std::size_t i = 0; late && i < 3; ++i) s.foot_in_trunk_m[0][i] += off_m[i];
    out.push_back(s);
  }
  return out;
}

TEST(StandPushScoreTest, CountsWhatAJointCarriesAboveItsOwnStaticTorque) {
  const PushScore score = score_push(samples(-8.0, 5.0));
  EXPECT_NEAR(score.static_output_Nm, 12.0, 1e-9);
  EXPECT_NEAR(score.excess_output_Nm, 8.0, 1e-9);
  EXPECT_NEAR(score.excess_motor_Nm, 4.0, 1e-9);
}

TEST(StandPushScoreTest, TheWorstJointCountsAndATorqueOfTheOtherSignOnlyByItsSize) {
  EXPECT_NEAR(score_push(samples(-1.0, 6.0)).excess_output_Nm, 6.0, 1e-9);
  EXPECT_NEAR(score_push(samples(0.0, -10.0)).excess_output_Nm, 4.0, 1e-9);
  EXPECT_NEAR(score_push(samples(10.0, 0.0)).excess_output_Nm, 0.0, 1e-9);  // unloaded
}

TEST(StandPushScoreTest, FeetAreComparedWithWhereTheyWereBefore) {
  EXPECT_NEAR(score_push(samples(0.0, 0.0)).foot_off_mm, 0.0, 1e-9);
  EXPECT_NEAR(score_push(samples(0.0, 0.0, {0.003, 0.0, -0.004})).foot_off_mm, 5.0, 1e-6);
}

TEST(StandPushScoreTest, APushWithoutABeforeOrAnAfterIsRefused) {
  std::vector<PushSample> all = samples(1.0, 1.0);
  EXPECT_THROW(score_push({}), std::invalid_argument);
  EXPECT_THROW(score_push({all.begin(), all.begin() + 400}), std::invalid_argument);
  EXPECT_THROW(score_push({all.begin() + 600, all.end()}), std::invalid_argument);
}

TEST(StandPushScoreTest, RatioOfNothingIsNone) {
  EXPECT_NEAR(push_ratio(3.0, 10.0), 0.3, 1e-12);
  EXPECT_TRUE(std::isnan(push_ratio(3.0, 0.0)));
}

}  // namespace
}  // namespace sprung
