/// A walk that is stopped or changed, and requests that are refused.
#include "tests/planner/gait/walk_fixture.h"

namespace sprung {
namespace {

class WalkChangeTest : public WalkFixture {
 protected:
  /// Legs in the order in which they leave the ground.
  std::vector<std::string> lifts(double seconds) {
    std::vector<std::string> out;
    std::vector<LegPhase> before(4, LegPhase::kStance);
    for (std::size_t i = 0; i < 4; ++i) before[i] = wanted_[i].phase;
    run(seconds, [&] {
      for (std::size_t i = 0; i < 4; ++i) {
        if (before[i] == LegPhase::kStance && wanted_[i].phase == LegPhase::kSwing)
          out.push_back(robot_.legs[i].name);
        before[i] = wanted_[i].phase;
      }
    });
    return out;
  }
};

TEST_F(WalkChangeTest, StopSlowsDownSetsTheFeetInTheirPlacesAndEnds) {
  for (const char* name : {"crawl", "walk", "trot"}) {
    const double speed = name == std::string("crawl") ? 0.1 : 0.2;
    begin(request(name, {speed, 0.0, 0.0}));
    run(6.0);
    walk_.stop();
    double before = motion_.desired_speed[0];
    const double most_m_s2 = std::max(preset_.walk.acceleration_m_s2, speed / 0.6);
    run(15.0, [&] {
      EXPECT_LE(before - motion_.desired_speed[0], most_m_s2 * kStep_s + 1e-12);
      before = motion_.desired_speed[0];
    });
    EXPECT_TRUE(walk_.ended()) << name;
    EXPECT_EQ(standing(), 4);
    EXPECT_EQ(walk_.failure(), nullptr);
    EXPECT_LT(place_error_m(), 0.03) << name;
  }
}

TEST_F(WalkChangeTest, HaltEndsInTimeFromAnyMomentOfAnyGaitOnFeetThatAreNotMovedAnyMore) {
  for (const char* name : {"crawl", "walk", "trot"}) {
    const double speed = name == std::string("crawl") ? 0.1 : 0.2;
    for (int moment = 0; moment < 12; ++moment) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(moment));
      begin(request(name, {speed, 0.0, 0.0}));
      run(4.0 + 0.31 * moment);
      walk_.halt();
      const std::int64_t began_us = in_.stamp.utime_us;
      run(10.0);
      ASSERT_TRUE(walk_.ended());
      EXPECT_LE(1e-6 * static_cast<double>(in_.stamp.utime_us - began_us),
                Walk::kHalt_s + preset_.walk.force_rise_s + 2.0 * kStep_s);
      EXPECT_EQ(standing(), 4);
      EXPECT_EQ(motion_.desired_speed, (Vec3{0.0, 0.0, 0.0}));
      EXPECT_EQ(walk_.failure(), nullptr);
      if (name == std::string("trot")) {
        EXPECT_LT(place_error_m(), 0.03) << "it has the time to set its feet";
      }
    }
  }
}

TEST_F(WalkChangeTest, HaltThatIsTakenBackAtAnyMomentWalksOn) {
  for (int moment = 0; moment < 12; ++moment) {
    begin(request("crawl", {0.1, 0.0, 0.0}));
    run(4.5 + 0.26 * moment);
    walk_.halt();
    run(0.2);
    change(request("crawl", {0.1, 0.0, 0.0}));
    const std::vector<std::string> lifted = lifts(8.0);
    EXPECT_GE(lifted.size(), 7u) << moment;
    EXPECT_FALSE(walk_.ended()) << moment << (walk_.failure() == nullptr ? "" : walk_.failure());
  }
}

TEST_F(WalkChangeTest, StopAfterAHaltDoesNotSetTheFeetEither) {
  begin(request("crawl", {0.1, 0.0, 0.0}));
  run(5.0);
  walk_.halt();
  run(0.1);
  walk_.stop();
  EXPECT_LE(lifts(10.0).size(), 1u);
  EXPECT_TRUE(walk_.ended());
}

TEST_F(WalkChangeTest, OtherGaitBeginsWhenAllFeetStand) {
  begin(request("walk", {0.2, 0.0, 0.0}));
  run(3.3);
  ASSERT_LT(standing(), 4);
  change(request("trot", {0.3, 0.0, 0.0}));
  while (motion_.gait == gait("walk")) {
    const int stood = standing();
    cycle();
    if (motion_.gait == gait("trot")) {
      EXPECT_EQ(standing(), 4) << stood;
    }
  }
  run(2.0);
  EXPECT_EQ(motion_.gait, gait("trot"));
  EXPECT_NEAR(motion_.desired_speed[0], 0.3, 1e-9);
}

/// A trot backward that is to be a walk forward: on a ramp the first leg that the walk lifts is the one that
/// it falls on.
TEST_F(WalkChangeTest, OtherGaitBeginsWhenTheBodyGoesNoFasterThanItAndNotTheOtherWay) {
  begin(request("trot", {-0.28, 0.0, 0.0}));
  run(6.0);
  change(request("walk", {0.1, 0.05, 0.0}));
  double switched_m_s = -1.0;
  run(4.0, [&] {
    if (switched_m_s == -1.0 && motion_.gait == gait("walk")) switched_m_s = motion_.desired_speed[0];
  });
  EXPECT_EQ(motion_.gait, gait("walk"));
  EXPECT_GT(switched_m_s, -0.03);
  change(request("trot", {-0.2, 0.0, 0.0}));
  run(4.0);
  EXPECT_EQ(motion_.gait, gait("trot")) << "which goes both ways";
  begin(request("trot", {0.4, 0.0, 0.0}));
  run(6.0);
  change(request("walk", {0.2, 0.0, 0.0}));
  run(4.0, [&] {
    if (motion_.gait != gait("walk")) return;
    EXPECT_LE(motion_.desired_speed[0], 0.21 + 1e-9);
  });
  EXPECT_EQ(motion_.gait, gait("walk"));
}

/// A robot whose feet stop swinging at speed would fall over them.
TEST_F(WalkChangeTest, GaitThatNeverSwingsBeginsOnlyWhenTheRobotStandsStillOverItsFeet) {
  for (const char* name : {"crawl", "walk", "trot"}) {
    const double speed = name == std::string("crawl") ? 0.1 : 0.2;
    begin(request(name, {speed, 0.0, 0.0}));
    run(6.0);
    change(request("stand"));
    int with_speed = 0;
    run(15.0, [&] { with_speed += motion_.gait == gait("stand") && motion_.desired_speed[0] != 0.0; });
    EXPECT_EQ(with_speed, 0) << name;
    EXPECT_EQ(motion_.gait, gait("stand")) << name;
    EXPECT_FALSE(walk_.ended());
    EXPECT_LT(place_error_m(), 0.06) << name;
    change(request("trot", {0.2, 0.0, 0.0}));
    run(3.0);
    EXPECT_EQ(motion_.gait, gait("trot"));
    walk_.stop();
    run(10.0);
    EXPECT_TRUE(walk_.ended());
  }
}

/// The order that keeps a crawl from tipping forward, turned round: which foot is ahead of which is a matter
/// of the way it goes.
TEST_F(WalkChangeTest, BackwardFrontAndHindLegsChangePlacesInTheOrder) {
  begin(request("crawl", {0.08, 0.0, 0.0}));
  const std::vector<std::string> forward = lifts(4.0);
  begin(request("crawl", {-0.08, 0.0, 0.0}));
  const std::vector<std::string> backward = lifts(4.0);
  ASSERT_GE(forward.size(), 4u);
  ASSERT_GE(backward.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    std::string mirrored = forward[i];
    mirrored[0] = mirrored[0] == 'f' ? 'h' : 'f';
    EXPECT_EQ(backward[i], mirrored) << i;
  }
}

TEST_F(WalkChangeTest, OrderOfLegsTurnsRoundWhileAllFeetStandAndSidewaysItStays) {
  begin(request("crawl", {0.08, 0.0, 0.0}));
  run(7.0);
  while (standing() == 4) cycle();
  change(request("crawl", {-0.08, 0.0, 0.0}));
  run(8.0, [&] { ASSERT_GE(standing(), 3); });
  const std::vector<std::string> backward = lifts(4.0);
  change(request("crawl", {0.0, 0.02, 0.0}));
  run(3.4);
  const std::vector<std::string> sideways = lifts(4.0);
  begin(request("crawl", {-0.08, 0.0, 0.0}));
  const std::vector<std::string> from_rest = lifts(9.0);
  const auto follows = [&](const std::vector<std::string>& order) {
    return std::search(from_rest.begin(), from_rest.end(), order.begin(), order.end()) != from_rest.end();
  };
  EXPECT_GE(backward.size(), 3u);
  EXPECT_TRUE(follows(backward));
  EXPECT_GE(sideways.size(), 3u);
  EXPECT_TRUE(follows(sideways));
}

TEST_F(WalkChangeTest, TrotIsItsOwnMirrorImageAndGoesOnBackward) {
  begin(request("trot", {0.2, 0.0, 0.0}));
  run(3.0);
  change(request("trot", {-0.2, 0.0, 0.0}));
  double before = motion_.gait_phase;
  run(3.0, [&] {
    const double on = std::remainder(motion_.gait_phase - before, 1.0);
    ASSERT_GE(on, 0.0);
    ASSERT_LT(on, 0.01);
    before = motion_.gait_phase;
  });
}

TEST_F(WalkChangeTest, StopBeforeAnotherGaitBeganStopsTheOneThatIsWalked) {
  begin(request("walk", {0.2, 0.0, 0.0}));
  run(3.3);
  ASSERT_LT(standing(), 4);
  change(request("trot", {0.3, 0.0, 0.0}));
  cycle();
  ASSERT_EQ(motion_.gait, gait("walk"));
  walk_.stop();
  run(10.0, [&] { EXPECT_NE(motion_.gait, gait("trot")); });
  EXPECT_TRUE(walk_.ended());
  EXPECT_LT(place_error_m(), 0.06);
}

TEST_F(WalkChangeTest, RequestForTheSameGaitTakesBackAStopAndAnotherGait) {
  begin(request("walk", {0.2, 0.0, 0.0}));
  run(3.0);
  walk_.stop();
  run(0.5);
  change(request("walk", {0.2, 0.0, 0.0}));
  change(request("trot"));
  change(request("walk", {0.2, 0.0, 0.0}));
  run(5.0);
  EXPECT_FALSE(walk_.ended());
  EXPECT_EQ(motion_.gait, gait("walk"));
  EXPECT_DOUBLE_EQ(motion_.desired_speed[0], 0.2);
  EXPECT_GT(motion_.legs[0].phase_time_s + motion_.legs[1].phase_time_s, 0.0);
}

TEST_F(WalkChangeTest, TransitionsAreThoseOfTheTable) {
  for (const GaitConfig& from : robot_.gaits) {
    begin(request(from.name));
    for (const GaitConfig& to : robot_.gaits) {
      const bool listed = std::find(from.to.begin(), from.to.end(), to.name) != from.to.end();
      const char* why = walk_.validate(request(to.name), true);
      if (listed || from.name == to.name) {
        EXPECT_EQ(why, nullptr) << from.name << " to " << to.name;
      } else {
        EXPECT_STREQ(why, "no transition between these gaits: stop first") << from.name << " to " << to.name;
      }
      EXPECT_EQ(walk_.validate(request(to.name), false), nullptr) << "from standing every gait may begin";
    }
  }
}

TEST_F(WalkChangeTest, RequestsThatCannotBeAreRefusedWithTheirReason) {
  const auto why = [&](auto change_it) {
    WalkRequest wrong = request("trot");
    change_it(wrong);
    const char* text = walk_.validate(wrong, false);
    return std::string(text == nullptr ? "" : text);
  };
  for (const int unknown : {-1, 4, 1000})
    EXPECT_EQ(why([&](WalkRequest& r) { r.gait = unknown; }), "unknown gait");
  for (const double wrong : {0.41, kNaN})
    EXPECT_EQ(why([&](WalkRequest& r) { r.speed[0] = wrong; }), "faster forward than this gait goes");
  EXPECT_EQ(why([&](WalkRequest& r) { r.speed[0] = -0.29; }), "faster backward than this gait goes");
  for (const double wrong : {0.13, -0.13, kNaN})
    EXPECT_EQ(why([&](WalkRequest& r) { r.speed[1] = wrong; }), "faster sideways than this gait goes");
  for (const double wrong : {0.41, -0.41, kNaN})
    EXPECT_EQ(why([&](WalkRequest& r) { r.speed[2] = wrong; }), "faster turning than this gait goes");
  for (const double wrong : {0.31, 0.56, kNaN})
    EXPECT_EQ(why([&](WalkRequest& r) { r.height_m = wrong; }),
              "body height beyond 60 to 105 % of the preset's stand_length");
  for (const double wrong : {-0.06, 0.16, kNaN})
    EXPECT_EQ(why([&](WalkRequest& r) { r.stance_width_m = wrong; }), "stance width beyond -50 to 150 mm");
  EXPECT_EQ(why([](WalkRequest& r) { r.speed = {-0.17, 0.06, -0.2}; }), "");
  for (const double forward : {-0.28, 0.4}) {
    EXPECT_EQ(why([&](WalkRequest& r) { r.speed = {forward, 0.0, 0.0}; }), "");
    EXPECT_EQ(why([&](WalkRequest& r) {
                r.speed = {forward, 0.05, 0.0};
              }),
              "faster forward, sideways and turning together than this gait goes");
  }
}

TEST_F(WalkChangeTest, RobotWithoutGaitsSaysSo) {
  RobotConfig robot = robot_;
  robot.gaits.clear();
  EXPECT_STREQ(Walk(robot, preset_).validate(request("trot"), false), "this robot has no gaits");
}

TEST_F(WalkChangeTest, WarmMotorsSlowItAndThenItSetsItsFeetAndSaysWhy) {
  for (const char* name : {"crawl", "walk", "trot"}) {
    const auto warm = [this](double share) { in_.joints[7].winding_share = share; };
    const double speed = name == std::string("crawl") ? 0.1 : 0.2;
    warm(0.5);
    begin(request(name, {speed, 0.0, 0.0}));
    run(6.0);
    EXPECT_EQ(motion_.desired_speed[0], speed);
    warm(0.5 * (MotorHeat::kSlowFrom + MotorHeat::kStands));
    run(2.0);
    EXPECT_FALSE(walk_.ended());
    EXPECT_LT(motion_.desired_speed[0], 0.7 * speed);
    warm(MotorHeat::kStands + 0.01);
    run(10.0);
    EXPECT_TRUE(walk_.ended()) << name;
    EXPECT_EQ(standing(), 4);
    ASSERT_NE(walk_.failure(), nullptr);
    EXPECT_NE(std::string(walk_.failure()).find("too warm"), std::string::npos);
  }
}

}  // namespace
}  // namespace sprung
