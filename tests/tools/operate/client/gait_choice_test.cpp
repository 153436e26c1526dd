#include "tools/operate/client/gait_choice.h"

#include <gmock/gmock.h>

#include <stdexcept>

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

GaitConfig gait(const char* name, double duty, double forward, double sideways, double turning) {
  GaitConfig out;
  out.name = name;
  out.duty = duty;
  out.fastest_forward_m_s = out.fastest_backward_m_s = forward;
  out.fastest_sideways_m_s = sideways;
  out.fastest_turning_rad_s = turning;
  return out;
}

class GaitChoiceTest : public testing::Test {
 protected:
  GaitChoiceTest() {
    robot_.name = "beast";
    robot_.gaits = {gait("stand", 1.0, 0.0, 0.0, 0.0), gait("crawl", 0.85, 0.12, 0.2, 0.15),
                    gait("trot", 0.6, 0.45, 0.15, 0.5), gait("walk", 0.7, 0.3, 0.1, 0.3)};
  }
  static constexpr int kStand = 0, kCrawl = 1, kTrot = 2, kWalk = 3;
  RobotConfig robot_;
};

TEST_F(GaitChoiceTest, WithoutANameTheFastestThatCanGoThatSpeed) {
  EXPECT_EQ(choose_gait(robot_, {"", 0.05}).gait, kTrot);
  EXPECT_EQ(choose_gait(robot_, {"", -0.45}).gait, kTrot);
  EXPECT_EQ(choose_gait(robot_, {"", kNaN, 0.18}).gait, kCrawl) << "only crawl goes sideways so fast";
  EXPECT_EQ(choose_gait(robot_, {"", 0.0, 0.0, 0.0}).gait, kTrot) << "on the spot; standing is no step";
}

TEST_F(GaitChoiceTest, WhileItWalksItsGaitIsKeptWhereThatCanGoSoFast) {
  EXPECT_EQ(choose_gait(robot_, {"", 0.1}, kCrawl).gait, kCrawl);
  EXPECT_EQ(choose_gait(robot_, {"", 0.25}, kWalk).gait, kWalk);
  EXPECT_EQ(choose_gait(robot_, {"", 0.2}, kCrawl).gait, kTrot);
  EXPECT_EQ(choose_gait(robot_, {"", 0.2}, kStand).gait, kTrot) << "standing in a gait is not walking";
  EXPECT_EQ(choose_gait(robot_, {"walk", 0.2}, kCrawl).gait, kWalk);
  EXPECT_EQ(choose_gait(robot_, {"", 0.2}, 77).gait, kTrot);
}

TEST_F(GaitChoiceTest, SpeedIsWhatWasSaidElseTwoThirdsOfTheFastest) {
  EXPECT_THAT(choose_gait(robot_, {"crawl"}).speed,
              testing::Pointwise(testing::DoubleNear(1e-12), {0.08, 0.0, 0.0}));
  EXPECT_EQ(choose_gait(robot_, {"trot", 0.2}).speed, (Vec3{0.2, 0.0, 0.0}));
  EXPECT_EQ(choose_gait(robot_, {"trot", kNaN, -0.1}).speed, (Vec3{0.0, -0.1, 0.0}));
  EXPECT_EQ(choose_gait(robot_, {"trot", 0.1, kNaN, 0.4}).speed, (Vec3{0.1, 0.0, 0.4}));
  EXPECT_EQ(choose_gait(robot_, {"stand"}).speed, (Vec3{0.0, 0.0, 0.0}));
}

TEST_F(GaitChoiceTest, WhatNoGaitGoesIsRefusedWithTheGaitsThereAre) {
  const auto refuses = [&](const GaitWish& wish, const auto& text) {
    EXPECT_THAT([&] { choose_gait(robot_, wish); }, ThrowsMessage<std::invalid_argument>(text));
  };
  const auto all = HasSubstr("crawl 0.12 0.2 0.15, trot 0.45 0.15 0.5, walk 0.3 0.1 0.3");
  refuses({"gallop"}, AllOf(HasSubstr("no gait 'gallop'"), all));
  refuses({"", 0.5}, AllOf(HasSubstr("no gait goes 0.5 m/s forward"), all));
  refuses({"crawl", 0.2}, AllOf(HasSubstr("crawl does not go 0.2 m/s forward"), all));
  refuses({"walk", 0.2, 0.0, -0.31}, HasSubstr("turning -0.31 rad/s"));
  refuses({"", std::numeric_limits<double>::infinity()}, HasSubstr("no gait goes inf"));
}

TEST_F(GaitChoiceTest, RobotWithoutGaitsDoesNotWalk) {
  robot_.gaits.clear();
  EXPECT_THAT([&] { choose_gait(robot_, {"trot"}); },
              ThrowsMessage<std::invalid_argument>("beast has no gaits: it does not walk"));
}

}  // namespace
}  // namespace sprung
