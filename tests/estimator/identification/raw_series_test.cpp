#include "estimator/identification/raw_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "tests/estimator/identification/identification_fixture.h"
#include "tests/support/refusal.h"

namespace sprung::identification {
namespace {

using testing::HasSubstr;

constexpr double kForever = std::numeric_limits<double>::infinity();

/// 100 Hz with jitter of a fifth of a period; position sin(t), torque 2 t.
RawSeries jittered(int samples) {
  RawSeries out;
  for (int i = 0; i < samples; ++i) {
    const double t = 0.01 * (i + 0.2 * std::sin(1.7 * i) * (i > 0));
    out.time_s.push_back(1297.5 + t);
    out.position_rad.push_back(std::sin(t));
    out.measured_torque.push_back(2.0 * t);
  }
  return out;
}

std::string refusal(const RawSeries& series, const TimeSpan& span = {0.0, kForever}) {
  return test::refusal_of([&] { prepare(series, span, {}); });
}

TEST(RawSeries, JitterIsResampledAndMotionComesWithoutPhase) {
  const auto pieces = prepare(jittered(600), {0.0, kForever}, {100.0});
  ASSERT_EQ(pieces.size(), 1u);
  const JointDataset& data = pieces[0].data;
  EXPECT_EQ(data.period_s, 0.01);
  for (Eigen::Index i = 0; i < data.size(); ++i) {
    const double t = data.time_s[i];
    EXPECT_NEAR(t, 0.01 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(data.measured_torque[i], 2.0 * t, 1e-9);
    EXPECT_NEAR(data.position_rad[i], std::sin(t), 3e-5);
    EXPECT_NEAR(data.velocity_rad_s[i], std::cos(t), 6e-3);
    const bool inner = i > 10 && i < data.size() - 10;
    EXPECT_NEAR(data.acceleration_rad_s2[i], -std::sin(t), inner ? 0.05 : 0.5);
  }
}

TEST(RawSeries, RecordedVelocityIsKeptAndGivesTheAcceleration) {
  RawSeries series = jittered(400);
  for (const double t : series.time_s) series.velocity_rad_s.push_back(3.0 * (t - 1297.5));
  const JointDataset data = prepare(series, {0.0, kForever}, {100.0}).front().data;
  EXPECT_NEAR(data.velocity_rad_s[200], 6.0, 1e-9);
  EXPECT_NEAR(data.acceleration_rad_s2[0], 3.0, 1e-6);
  EXPECT_NEAR(data.acceleration_rad_s2[200], 3.0, 1e-6);
}

TEST(RawSeries, RepeatedTimeStampsBecomeTheirMean) {
  RawSeries series;
  series.time_s = {0.0, 0.01, 0.01, 0.01, 0.02, 0.03};
  series.position_rad = {0, 0, 0, 0, 0, 0};
  series.measured_torque = {1, 2, 5, 8, 1, 1};
  const JointDataset data = prepare(series, {0.0, kForever}, {100.0}).front().data;
  ASSERT_EQ(data.size(), 4);
  EXPECT_NEAR(data.measured_torque[1], 5.0, 1e-12);
}

TEST(RawSeries, RateIsTheRecordingsOwnUnlessAskedFor) {
  EXPECT_NEAR(prepare(jittered(300), {0.0, kForever}, {}).front().data.period_s, 0.01, 5e-4);
  EXPECT_EQ(prepare(jittered(300), {0.0, kForever}, {50.0}).front().data.period_s, 0.02);
}

TEST(RawSeries, GapsAreNotBridged) {
  RawSeries series = jittered(300);
  for (std::size_t i = 150; i < 300; ++i) series.time_s[i] += 2.0;
  const auto pieces = prepare(series, {0.0, kForever}, {100.0});
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_LT(pieces[0].data.time_s.maxCoeff(), 1.5);
  EXPECT_GT(pieces[1].data.time_s.minCoeff(), 3.49);
}

TEST(RawSeries, APartLiesOnTheGridOfTheWhole) {
  const RawSeries series = jittered(600);
  const JointDataset all = prepare(series, {1.0, 5.0}, {100.0}).front().data;
  const JointDataset part = prepare(series, {1.0, 3.0}, {100.0}).front().data;
  EXPECT_NEAR(all.time_s[0], 1.0, 0.0101);
  EXPECT_EQ(all.time_s.head(part.size()), part.time_s);
  EXPECT_LT(part.time_s.maxCoeff(), 3.0);
}

TEST(RawSeries, APartKnowsNothingOfItsNeighbours) {
  RawSeries series = jittered(600);
  const JointDataset before = prepare(series, {1.0, 3.0}, {100.0}).front().data;
  for (std::size_t i = 0; i < series.time_s.size(); ++i) {
    const double t = series.time_s[i] - series.time_s[0];
    if (t < 1.0 || t >= 3.0) {
      series.position_rad[i] = 100.0 * noise(3, static_cast<Eigen::Index>(i));
      series.measured_torque[i] = 100.0 * noise(4, static_cast<Eigen::Index>(i));
    }
  }
  const JointDataset after = prepare(series, {1.0, 3.0}, {100.0}).front().data;
  EXPECT_EQ(before.position_rad, after.position_rad);
  EXPECT_EQ(before.velocity_rad_s, after.velocity_rad_s);
  EXPECT_EQ(before.acceleration_rad_s2, after.acceleration_rad_s2);
  EXPECT_EQ(before.measured_torque, after.measured_torque);
}

TEST(RawSeries, NothingCountsBesideASampleThatDoesNot) {
  RawSeries series = jittered(400);
  series.weight.assign(400, 1.0);
  for (std::size_t i = 100; i <= 200; ++i) series.weight[i] = 0.0;
  const FitPiece piece = prepare(series, {0.0, kForever}, {100.0}).front();
  for (Eigen::Index i = 0; i < piece.data.size(); ++i) {
    const bool near = piece.data.time_s[i] > 0.99 - 0.004 && piece.data.time_s[i] < 2.01 + 0.004;
    EXPECT_EQ(piece.weight[i], near ? 0.0 : 1.0) << i;
  }
}

TEST(RawSeries, WeightsMarkSpansWithoutTheirEnds) {
  const JointDataset data = prepare(jittered(600), {0.0, kForever}, {100.0}).front().data;
  const Eigen::VectorXd weight = weight_within(data, {{1.0, 2.0}, {3.0, 3.5}});
  EXPECT_EQ(weight.sum(), 150.0);
  EXPECT_EQ(weight[99], 0.0);
  EXPECT_EQ(weight[100], 1.0);
  EXPECT_EQ(weight[199], 1.0);
  EXPECT_EQ(weight[200], 0.0);
}

TEST(RawSeries, MistakesAreNamed) {
  EXPECT_THAT(refusal(RawSeries()), HasSubstr("no samples"));
  RawSeries series = jittered(50);
  series.position_rad[7] = std::nan("");
  EXPECT_THAT(refusal(series), HasSubstr("position of sample 7"));
  series = jittered(50);
  series.link_position_rad.resize(3);
  EXPECT_THAT(refusal(series), HasSubstr("link position has 3 samples, time has 50"));
  series = jittered(50);
  std::swap(series.time_s[10], series.time_s[20]);
  EXPECT_THAT(refusal(series), HasSubstr("time goes back"));
  EXPECT_THAT(refusal(jittered(50), {100.0, 200.0}), HasSubstr("0 samples between"));
}

}  // namespace
}  // namespace sprung::identification
