#include "planner/gait/walk.h"

#include "planner/gait/support_triangle.h"
#include "tests/planner/gait/walk_fixture.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

class WalkTest : public WalkFixture {};

TEST_F(WalkTest, BeginsWhereTheFeetAreWithTheirShareOfTheWeight) {
  begin(request("trot", {0.3, 0.0, 0.0}));
  cycle();
  double weight_N = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 place = walk_.stance_foot_in_hip_m(i, preset_.stand_length_m);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(wanted_[i].desired_foot_in_hip_m[k], place[k], 1e-4);
    EXPECT_EQ(wanted_[i].control_mode, ControlMode::kCompliance);
    EXPECT_EQ(wanted_[i].stiffness_N_m, preset_.walk.stance.stiffness_N_m);
    weight_N -= wanted_[i].feedforward_force_N[2];
  }
  EXPECT_NEAR(std::abs(weight_N), 30.0 * kGravity_m_s2, 15.0);
}

TEST_F(WalkTest, StandsOnVirtualSpringsInTheGaitWhoseLegsNeverSwing) {
  begin(request("stand"));
  run(3.0, [&] { ASSERT_EQ(standing(), 4); });
  EXPECT_FALSE(walk_.ended());
  EXPECT_LT(place_error_m(), 1e-6);
}

TEST_F(WalkTest, SpeedIsRampedAndTheFeetKeepTheirPlacesOnAverage) {
  begin(request("trot", {0.35, 0.0, 0.0}));
  run(0.5);
  EXPECT_NEAR(motion_.desired_speed[0], 0.5 * preset_.walk.acceleration_m_s2, 2e-3);
  run(3.0);
  EXPECT_DOUBLE_EQ(motion_.desired_speed[0], 0.35);
  double sum_m = 0.0;
  int cycles = 0;
  run(2.4, [&] {
    for (const EstimatedLeg& leg : in_.legs) sum_m += leg.estimated_foot_in_hip_m[0];
    cycles += 4;
  });
  EXPECT_NEAR(sum_m / cycles, 0.0, 0.01);
}

/// Level ground, and a ramp ahead.
TEST_F(WalkTest, OnARampTheTrunkLiesAlongItAndFeetFindItUnderTheirHips) {
  constexpr double kRamp = 0.15, kFrom_m = 0.7;
  double way_m = 0.0, ahead_m = 0.0;
  int cycles = 0;
  const auto lay_floor = [&] {
    way_m += kStep_s * motion_.desired_speed[0];
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d foot_m = level_foot_m(i);
      if (wanted_[i].phase != LegPhase::kStance)
        floor_m_[i] = kRamp * std::max(0.0, foot_m.x() + way_m - kFrom_m);
      ahead_m += (foot_m - level_from_trunk_ * hip_m(i)).x();
      ++cycles;
    }
  };
  begin(request("trot", {0.3, 0.0, 0.0}));
  run(15.0, lay_floor);
  const std::int32_t late = count(LegEvent::kLateContact), early = count(LegEvent::kEarlyContact);
  ahead_m = cycles = 0;
  run(2.4, lay_floor);
  const Attitude wanted = attitude_along({kRamp, 0.0});
  EXPECT_NEAR(walk_.wanted_trunk().pitch_rad, wanted.pitch_rad, 0.01);
  EXPECT_NEAR(walk_.wanted_trunk().roll_rad, 0.0, 0.01);
  EXPECT_EQ(count(LegEvent::kLateContact), late);
  EXPECT_EQ(count(LegEvent::kEarlyContact), early);
  EXPECT_NEAR(ahead_m / cycles, 0.0, 0.015);
  EXPECT_EQ(walk_.failure(), nullptr);
}

TEST_F(WalkTest, TurningFeetGoRoundTheMiddle) {
  begin(request("trot", {0.0, 0.0, 0.4}));
  run(4.0);
  run(1.2, [&] {
    for (std::size_t i = 0; i < 4; ++i) {
      if (wanted_[i].phase != LegPhase::kStance) continue;
      const double y_m = robot_.legs[i].hip_in_trunk_m[1] + wanted_[i].desired_foot_in_hip_m[1];
      ASSERT_NEAR(wanted_[i].desired_foot_velocity_m_s[0], motion_.desired_speed[2] * y_m, 0.02);
    }
  });
}

TEST_F(WalkTest, HeadingIsHeldByTheImuAndNotWithout) {
  for (const bool imu : {true, false}) {
    in_.body.uses_imu = false;
    begin(request("stand"));
    in_.body.uses_imu = imu;
    in_.body.estimated_quaternion_wxyz = {std::cos(0.05), 0.0, 0.0,
                                          std::sin(0.05)};  // turned left by 0.1 rad
    cycle();
    // Feet go left round the middle, so that the trunk turns back right.
    const double expected = imu ? -0.1 : 0.0;
    EXPECT_NEAR(wanted_[0].desired_foot_velocity_m_s[1], -expected * 0.33, 0.01);
    in_.body.estimated_quaternion_wxyz = {1.0, 0.0, 0.0, 0.0};
  }
}

TEST_F(WalkTest, CrawlHasTheBodyOverThreeFeetWhenTheFourthLeaves) {
  begin(request("crawl"));
  int checked = 0;
  std::vector<LegPhase> before(4, LegPhase::kStance);
  run(12.0, [&] {
    for (std::size_t i = 0; i < 4; ++i) {
      const bool lifts = before[i] == LegPhase::kStance && wanted_[i].phase == LegPhase::kSwing;
      before[i] = wanted_[i].phase;
      if (!lifts) continue;
      std::array<Eigen::Vector2d, 3> others;
      for (std::size_t k = 0, n = 0; k < 4; ++k) {
        const Vec3& foot = in_.legs[k].estimated_foot_in_hip_m;
        const Vec3& hip = robot_.legs[k].hip_in_trunk_m;
        if (k != i) others[n++] = {hip[0] + foot[0], hip[1] + foot[1]};
      }
      EXPECT_GT(SupportTriangle(others).margin_m({0.0, 0.0}), 0.01) << robot_.legs[i].name;
      ++checked;
    }
  });
  EXPECT_GE(checked, 8);
}

TEST_F(WalkTest, HeightAndWidthFollowTheirRequestSlowly) {
  begin(request("walk"));
  run(1.0);
  WalkRequest other = request("walk");
  other.height_m = 0.44;
  other.stance_width_m = 0.06;
  change(other);
  Vec3 before = wanted_[0].desired_foot_in_hip_m;
  run(4.0, [&] {
    if (wanted_[0].phase == LegPhase::kStance) {
      EXPECT_LT(std::abs(wanted_[0].desired_foot_in_hip_m[2] - before[2]), 2e-3);
    }
    before = wanted_[0].desired_foot_in_hip_m;
  });
  EXPECT_NEAR(in_.legs[0].estimated_foot_in_hip_m[1], 0.08 + 0.06, 0.01);
  EXPECT_NEAR(in_.legs[3].estimated_foot_in_hip_m[1], -0.08 - 0.06, 0.01);
  double wanted_m = 0.0;
  int stand = 0;
  for (const DesiredLeg& leg : wanted_) {
    if (leg.phase != LegPhase::kStance) continue;
    wanted_m += leg.desired_foot_in_hip_m[2];
    ++stand;
  }
  EXPECT_NEAR(wanted_m / stand, -0.44, 0.003);
}

TEST_F(WalkTest, LateContactFreezesTheClockUntilTheFootFoundTheGround) {
  begin(request("trot"));
  floor_m_[0] = -0.02;
  double frozen_s = 0.0;
  double before = -1.0;
  run(0.5, [&] {
    if (motion_.gait_phase == before) frozen_s += kStep_s;
    before = motion_.gait_phase;
  });
  EXPECT_EQ(count(LegEvent::kLateContact), 1);
  // It stood in the hole before it left: the mean of the feet knows a quarter of that, and the slope of their
  // newest prints as much of the rest as one foot that is off looks like a slope.
  const double approach_m_s = robot_.gaits[gait("trot")].approach_m_s;
  EXPECT_NEAR(frozen_s, 0.5 * 0.02 / approach_m_s, 0.01);
  EXPECT_EQ(walk_.failure(), nullptr);
}

TEST_F(WalkTest, CatchesUpWithWhatASpringLaggedBy) {
  const auto fastest_m_s = [&] {
    double fastest = 0.0;
    for (const DesiredLeg& leg : wanted_)
      if (leg.phase == LegPhase::kStance) fastest = std::max(fastest, -leg.desired_foot_velocity_m_s[0]);
    return fastest;
  };
  // Off where it is wanted before it leaves, and not as long as others land, who would take over a part of
  // it.
  const auto lags_by = [&](double behind_m) {
    return [this, behind_m] { slipped_m_[0] = standing() == 4 ? behind_m : 0.0; };
  };
  constexpr double kRound_s = 0.8, kLegs = 4.0;
  begin(request("trot", {0.3, 0.0, 0.0}));
  run(4.0);
  const double height_m = preset_.stand_length_m;
  const double rolls = height_m / (height_m + robot_.legs[0].foot_radius_m);  // of the body's speed
  EXPECT_NEAR(fastest_m_s(), rolls * 0.3, 1e-3);
  run(16.0, lags_by(0.02));
  EXPECT_NEAR(fastest_m_s(), rolls * (0.3 + 0.02 / kLegs / kRound_s), 2e-3);
  run(24.0, lags_by(-0.02));
  EXPECT_NEAR(fastest_m_s(), rolls * (0.3 - 0.02 / kLegs / kRound_s), 2e-3);
}

TEST_F(WalkTest, WhileAFootIsLateTheBodyWaitsForItToo) {
  begin(request("trot", {0.3, 0.0, 0.0}));
  run(2.0);
  floor_m_[1] = -1.0;
  while (count(LegEvent::kLateContact) == 0) cycle();
  run(0.25);
  ASSERT_EQ(walk_.failure(), nullptr);
  int stand = 0;
  for (const DesiredLeg& leg : wanted_) {
    if (leg.phase != LegPhase::kStance) continue;
    EXPECT_EQ(leg.desired_foot_velocity_m_s[0], 0.0);
    ++stand;
  }
  EXPECT_GT(stand, 0);
}

TEST_F(WalkTest, ABodyThatDoesNotComeOverThreeFeetEndsTheCrawlAndSaysWhy) {
  begin(request("crawl", {0.1, 0.0, 0.0}));
  for (int k = 0; k < 3500 && !walk_.ended(); ++k) {  // its feet stay where they are
    in_.stamp.utime_us += 2000;
    ++in_.stamp.seq;
    walk_.step(in_);
    look();
    EXPECT_EQ(standing(), 4);
  }
  EXPECT_TRUE(walk_.ended());
  EXPECT_STREQ(walk_.failure(), "the body cannot be brought over three feet");
}

TEST_F(WalkTest, FootThatMovesAgainstTheOthersSlippedAndIsWantedWhereItIs) {
  begin(request("stand"));
  run(0.5);
  const double before_m = wanted_[3].desired_foot_in_hip_m[0];
  slipped_m_[3] = 0.025;
  run(0.5);
  EXPECT_EQ(count(LegEvent::kSlip), 0);
  slipped_m_[3] = 0.035;
  cycle();
  slipped_m_[3] = 0.0;
  cycle();
  EXPECT_EQ(motion_.legs[3].last_event, LegEvent::kSlip);
  EXPECT_EQ(count(LegEvent::kSlip), 1);
  EXPECT_NEAR(wanted_[3].desired_foot_in_hip_m[0] - before_m, 0.035, 1e-3);
}

TEST_F(WalkTest, FootThatFellOffAnEdgeIsWantedWhereItIsInAGaitThatStandsOnThree) {
  for (const char* name : {"crawl", "trot"}) {
    begin(request(name));
    while (standing() != 4) cycle();
    const std::int32_t before = count(LegEvent::kSlip);
    floor_m_[3] -= 0.06;
    cycle();
    in_.legs[3].contact = false;
    in_.legs[3].foot_force_N = {0.0, 0.0, 0.0};
    cycle();
    EXPECT_EQ(count(LegEvent::kSlip) - before, name == std::string("crawl") ? 1 : 0) << name;
    floor_m_[3] += 0.06;
  }
}

TEST_F(WalkTest, FeetThatAllMoveTogetherWerePushedAndDoNotSlip) {
  begin(request("stand"));
  slipped_m_.fill(0.06);
  run(0.5);
  EXPECT_EQ(count(LegEvent::kSlip), 0);
}

TEST_F(WalkTest, PushedInAGaitThatStepsItGoesOnFromWhereItIsAndStandingItComesBack) {
  for (const char* name : {"trot", "stand"}) {
    begin(request(name));
    run(1.0);
    slipped_m_.fill(0.1);
    cycle();
    slipped_m_.fill(0.0);
    const JointState pushed = in_;
    cycle();
    double stretch_m = 0.0;
    for (std::size_t i = 0; i < 4; ++i)
      if (wanted_[i].phase == LegPhase::kStance)
        stretch_m = std::max(stretch_m, std::abs(wanted_[i].desired_foot_in_hip_m[0] -
                                                 pushed.legs[i].estimated_foot_in_hip_m[0]));
    EXPECT_NEAR(stretch_m, name == std::string("stand") ? 0.1 : 0.04, 0.005) << name;
  }
}

TEST_F(WalkTest, NoGroundStopsTheWalkAndSaysWhy) {
  begin(request("trot", {0.3, 0.0, 0.0}));
  run(2.0);
  ASSERT_EQ(walk_.failure(), nullptr);
  floor_m_[1] = -1.0;
  run(6.0);
  EXPECT_TRUE(walk_.ended());
  EXPECT_STREQ(walk_.failure(), "a foot found no ground");
  EXPECT_EQ(count(LegEvent::kNoGround), 1);
  EXPECT_EQ(motion_.legs[1].last_event, LegEvent::kNoGround);
}

TEST_F(WalkTest, WhileItStopsForWantOfGroundNothingElseIsTaken) {
  begin(request("trot", {0.3, 0.0, 0.0}));
  run(2.0);
  floor_m_[1] = -1.0;
  while (walk_.failure() == nullptr) cycle();
  ASSERT_FALSE(walk_.ended());
  EXPECT_STREQ(walk_.validate(request("trot"), true), "a foot found no ground");
  EXPECT_STREQ(walk_.validate(request("stand"), true), "a foot found no ground");
  run(5.0);
  ASSERT_TRUE(walk_.ended());
  floor_m_.fill(0.0);
  begin(request("trot"));
  EXPECT_EQ(walk_.failure(), nullptr);
}

TEST_F(WalkTest, EndedItSaysThatThereIsNoGait) {
  walk_.write(motion_);
  EXPECT_EQ(motion_.gait, -1);
  begin(request("stand"));
  EXPECT_EQ(motion_.gait, gait("stand"));
  walk_.stop();
  run(1.0);
  EXPECT_TRUE(walk_.ended());
  EXPECT_EQ(motion_.gait, -1);
}

TEST_F(WalkTest, StepsAllocateNothing) {
  begin(request("trot", {0.2, 0.08, 0.2}));
  const std::int64_t before = test::allocation_count();
  run(5.0);
  change(request("walk", {0.1, 0.0, 0.0}));
  run(3.0);
  walk_.stop();
  run(5.0);
  EXPECT_EQ(test::allocation_count(), before);
}

TEST_F(WalkTest, SameInputsGiveTheSameBits) {
  std::vector<Vec3> first;
  for (int again = 0; again < 2; ++again) {
    Walk other(robot_, preset_);
    JointState in = in_;
    other.begin(in, request("trot", {0.3, 0.1, 0.2}));
    for (int k = 0; k < 2000; ++k) {
      in.stamp.utime_us += 2000;
      in.legs[0].contact = k % 7 == 0;
      other.step(in);
      DesiredLeg leg;
      other.write(static_cast<std::size_t>(k % 4), leg);
      if (again == 0) {
        first.push_back(leg.desired_foot_in_hip_m);
      } else {
        ASSERT_EQ(leg.desired_foot_in_hip_m, first[k]);
      }
    }
  }
}

TEST_F(WalkTest, PeriodIsWholeOnlyFromItsBeginningOn) {
  begin(request("crawl", {0.05, 0.0, 0.0}));
  int began = 0, whole = 0;
  for (int k = 0; k < 6000; ++k) {
    cycle();
    began += walk_.period_begins() ? 1 : 0;
    whole += walk_.whole_period_ended() ? 1 : 0;
  }
  EXPECT_GE(began, 3);
  EXPECT_EQ(whole, began - 1) << "the first begins in its middle";
}

}  // namespace
}  // namespace sprung
