#include "planner/bezier.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

namespace sprung {
namespace {

TEST(BezierTest, ImpossibleCurvesAreRefused) {
  EXPECT_THROW(Bezier({1.0}, 1.0), std::invalid_argument);
  EXPECT_THROW(Bezier(std::vector<double>(18, 0.0), 1.0), std::invalid_argument);
  EXPECT_THROW(Bezier({0.0, 1.0}, 0.0), std::invalid_argument);
  EXPECT_THROW(Bezier({0.0, std::numeric_limits<double>::infinity()}, 1.0), std::invalid_argument);
}

TEST(BezierTest, StraightLineIsExact) {
  const CurvePoint p = Bezier({1.0, 3.0}, 0.5).at(0.125);
  EXPECT_DOUBLE_EQ(p.value, 1.5);
  EXPECT_DOUBLE_EQ(p.rate_1_s, 4.0);
  EXPECT_DOUBLE_EQ(p.acceleration_1_s2, 0.0);
}

TEST(BezierTest, EndsAndTheirDerivativesAreThoseOfTheControlPolygon) {
  const Bezier curve({0.35, 0.4028, 0.4258, 0.506, 0.634, 0.4905, 0.478}, 0.2);
  const CurvePoint start = curve.at(0.0);
  EXPECT_DOUBLE_EQ(start.value, 0.35);
  EXPECT_NEAR(start.rate_1_s, 6.0 * (0.4028 - 0.35) / 0.2, 1e-12);  // errata E9: starts with a speed step
  EXPECT_NEAR(start.acceleration_1_s2, 30.0 * (0.4258 - 2.0 * 0.4028 + 0.35) / 0.04, 1e-9);
  EXPECT_DOUBLE_EQ(curve.at(0.2).value, 0.478);
}

TEST(BezierTest, RestsOutsideItsTime) {
  const Bezier curve({1.0, 5.0, 2.0}, 1.0);
  EXPECT_EQ(curve.at(-0.1).value, 1.0);
  EXPECT_EQ(curve.at(-0.1).rate_1_s, 0.0);
  EXPECT_EQ(curve.at(1.1).value, 2.0);
  EXPECT_EQ(curve.at(1.1).acceleration_1_s2, 0.0);
}

TEST(BezierTest, AgreesWithBernsteinSumsAndFiniteDifferencesForEveryDegree) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int degree = 1; degree <= Bezier::kMaxDegree; ++degree) {
    std::vector<double> points(static_cast<std::size_t>(degree) + 1);
    for (double& p : points) p = unit(random);
    const double duration_s = 0.7;
    const Bezier curve(points, duration_s);
    const double t = 0.3;
    const double u = t / duration_s;
    double sum = 0.0, binomial = 1.0;
    for (int i = 0; i <= degree; ++i) {
      sum += binomial * std::pow(u, i) * std::pow(1.0 - u, degree - i) * points[i];
      binomial *= static_cast<double>(degree - i) / (i + 1);
    }
    constexpr double kStep = 1e-5;
    const double before = curve.at(t - kStep).value, now = curve.at(t).value,
                 after = curve.at(t + kStep).value;
    EXPECT_NEAR(now, sum, 1e-12);
    EXPECT_NEAR(curve.at(t).rate_1_s, (after - before) / (2 * kStep), 1e-6);
    EXPECT_NEAR(curve.at(t).acceleration_1_s2, (after - 2 * now + before) / (kStep * kStep), 1e-3);
  }
}

}  // namespace
}  // namespace sprung
