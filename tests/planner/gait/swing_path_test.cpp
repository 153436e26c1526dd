#include "planner/gait/swing_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sprung {
namespace {

constexpr double kSwingPathStep_s = 1e-4;

SwingPath path(double approach_s = 0.0) {
  SwingPath out;
  out.from_m = {-0.05, 0.12, -0.50};
  out.to_m = {0.07, 0.13, -0.49};
  out.ground_m_s = {-0.3, 0.05, -0.04};  // of a body that climbs
  out.duration_s = 0.24;
  out.lift_m = 0.05;
  out.approach_s = approach_s;
  out.approach_m_s = 0.2;
  return out;
}

std::vector<SwingPath> paths() {
  std::vector<SwingPath> out;
  for (const double approach_s : {0.0, 0.05, 0.1}) {
    for (const double lift_m : {0.0, 0.05, 0.12}) {
      out.push_back(path(approach_s));
      out.back().lift_m = lift_m;
    }
  }
  return out;
}

TEST(SwingPathTest, BeginsWhereTheFootStoodWithTheGround) {
  for (const SwingPath& swing : paths()) {
    const SwingPoint begin = swing.at(0.0);
    EXPECT_TRUE(begin.position_m.isApprox(swing.from_m, 1e-12));
    EXPECT_TRUE(begin.velocity_m_s.isApprox(swing.ground_m_s, 1e-12));
  }
}

TEST(SwingPathTest, WithoutApproachEndsOnTheGroundAndMovesWithIt) {
  const SwingPath swing = path();
  EXPECT_TRUE(swing.at(swing.duration_s).position_m.isApprox(swing.to_m, 1e-12));
  EXPECT_TRUE(swing.at(swing.duration_s).velocity_m_s.isApprox(swing.ground_m_s, 1e-9));
  const SwingPoint later = swing.at(swing.duration_s + 0.1);
  EXPECT_TRUE(later.position_m.isApprox(swing.to_m + 0.1 * swing.ground_m_s, 1e-12));
}

TEST(SwingPathTest, ApproachGoesStraightDownToTheGroundAndBeyondItAtItsSpeed) {
  const SwingPath swing = path(0.08);
  const double end_s = swing.duration_s;
  EXPECT_NEAR(swing.at(end_s).position_m.z(), swing.to_m.z(), 1e-12);
  EXPECT_NEAR(swing.at(end_s - 0.03).position_m.z(), swing.to_m.z() + (0.2 + 0.04) * 0.03, 1e-12);
  EXPECT_NEAR(swing.at(end_s + 0.1).position_m.z(), swing.to_m.z() - (0.2 + 0.04) * 0.1, 1e-12);
  for (const double time_s : {end_s - 0.07, end_s, end_s + 0.1})
    EXPECT_NEAR(swing.at(time_s).velocity_m_s.z(), -0.2 - 0.04, 1e-12);
}

TEST(SwingPathTest, AtTheEndThePlaceIsTheWantedOneWhateverTheApproach) {
  for (const SwingPath& swing : paths()) {
    const SwingPoint end = swing.at(swing.duration_s);
    EXPECT_NEAR((end.position_m - swing.to_m).norm(), 0.0, 1e-12);
    EXPECT_NEAR((end.velocity_m_s - swing.ground_m_s).head<2>().norm(), 0.0, 1e-9);
  }
}

TEST(SwingPathTest, VelocityIsTheChangeOfPosition) {
  for (const SwingPath& swing : paths()) {
    for (double time_s = kSwingPathStep_s; time_s < 0.4; time_s += kSwingPathStep_s) {
      const Eigen::Vector3d moved_m = swing.at(time_s + kSwingPathStep_s).position_m -
                                      swing.at(time_s).position_m;
      const Eigen::Vector3d middle_m_s = swing.at(time_s + 0.5 * kSwingPathStep_s).velocity_m_s;
      ASSERT_LT((moved_m - middle_m_s * kSwingPathStep_s).norm(), 0.15 * kSwingPathStep_s)
          << "at " << time_s << " lift " << swing.lift_m << " approach " << swing.approach_s;
    }
  }
}

TEST(SwingPathTest, AccelerationIsTheChangeOfVelocityAndTheRestlessPartHasNoStepsOfSpeed) {
  for (const SwingPath& swing : paths()) {
    for (double time_s = kSwingPathStep_s; time_s < swing.duration_s - swing.approach_s - kSwingPathStep_s;
         time_s += kSwingPathStep_s) {
      const Eigen::Vector3d change_m_s = swing.at(time_s + kSwingPathStep_s).velocity_m_s -
                                         swing.at(time_s).velocity_m_s;
      const Eigen::Vector3d middle_m_s2 = swing.at(time_s + 0.5 * kSwingPathStep_s).acceleration_m_s2;
      ASSERT_LT((change_m_s - middle_m_s2 * kSwingPathStep_s).norm(), 0.15 * kSwingPathStep_s)
          << "at " << time_s << " lift " << swing.lift_m << " approach " << swing.approach_s;
    }
    const double down_s = swing.duration_s - swing.approach_s;
    const double before_m_s = swing.at(down_s - 1e-9).velocity_m_s.z();
    EXPECT_NEAR(swing.at(down_s + 1e-9).velocity_m_s.z(), before_m_s, 1e-5);
    EXPECT_EQ(swing.at(swing.duration_s + 0.01).acceleration_m_s2.norm(), 0.0);
  }
}

/// Heat of motors that turn little else than their own rotors.
TEST(SwingPathTest, LiftsWithLessSquaredAccelerationThanAQuarticBump) {
  SwingPath swing = path();
  swing.to_m = swing.from_m;
  double spline = 0.0;
  double bump = 0.0;
  for (double time_s = 0.0; time_s < swing.duration_s; time_s += kSwingPathStep_s) {
    const double u = time_s / swing.duration_s;
    const double z_m_s2 = swing.lift_m * 16.0 * (2.0 - 12.0 * u + 12.0 * u * u) /
                          (swing.duration_s * swing.duration_s);
    const double own_m_s2 = swing.at(time_s).acceleration_m_s2.z();
    spline += own_m_s2 * own_m_s2;
    bump += z_m_s2 * z_m_s2;
  }
  EXPECT_LT(spline, 0.95 * bump);
}

TEST(SwingPathTest, RisesByItsLiftAndNeverBelowItsLine) {
  SwingPath swing = path();
  swing.to_m.z() = swing.from_m.z() + swing.ground_m_s.z() * swing.duration_s;
  double highest_m = -1.0;
  for (double time_s = 0.0; time_s < swing.duration_s; time_s += kSwingPathStep_s) {
    const double z_m = swing.at(time_s).position_m.z() - swing.ground_m_s.z() * time_s;
    EXPECT_GE(z_m, swing.from_m.z() - 1e-12);
    highest_m = std::max(highest_m, z_m);
  }
  EXPECT_NEAR(highest_m, swing.from_m.z() + swing.lift_m, 1e-6);
}

TEST(SwingPathTest, GroundThatMovesALittleMovesThePathALittle) {
  SwingPath moved = path(0.08);
  moved.to_m += Eigen::Vector3d(0.001, -0.001, 0.001);
  for (double time_s = 0.0; time_s < 0.3; time_s += 0.001)
    EXPECT_LE((moved.at(time_s).position_m - path(0.08).at(time_s).position_m).norm(), 0.0018);
}

TEST(SwingPathTest, ADetourGoesAsideInTheFirstThirdAndEndsWhereItWould) {
  const SwingPath straight = path(0.05);
  SwingPath aside = straight;
  aside.aside_m = {-0.03, 0.01};
  const double third_s = (straight.duration_s - straight.approach_s) / 3.0;
  EXPECT_TRUE((aside.at(third_s).position_m - straight.at(third_s).position_m)
                  .isApprox(Eigen::Vector3d(-0.03, 0.01, 0.0), 1e-9));
  for (const double time_s : {0.0, straight.duration_s - straight.approach_s, straight.duration_s}) {
    EXPECT_TRUE(aside.at(time_s).position_m.isApprox(straight.at(time_s).position_m, 1e-12)) << time_s;
    EXPECT_TRUE(aside.at(time_s).velocity_m_s.isApprox(straight.at(time_s).velocity_m_s, 1e-9)) << time_s;
  }
  for (double time_s = 0.01; time_s < 0.18; time_s += 0.01) {
    const SwingPoint before = aside.at(time_s - kSwingPathStep_s),
                     after = aside.at(time_s + kSwingPathStep_s);
    const Eigen::Vector3d rate = (after.position_m - before.position_m) / (2.0 * kSwingPathStep_s);
    const Eigen::Vector3d rate2 = (after.velocity_m_s - before.velocity_m_s) / (2.0 * kSwingPathStep_s);
    EXPECT_LT((rate - aside.at(time_s).velocity_m_s).norm(), 1e-4) << time_s;
    EXPECT_LT((rate2 - aside.at(time_s).acceleration_m_s2).head<2>().norm(), 1e-2) << time_s;
  }
}

}  // namespace
}  // namespace sprung
