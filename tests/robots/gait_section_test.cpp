/// `body`, `gaits` and a preset's `walk`, on the shipped pegasus and after one mistake each.
#include "robots/gait_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/changed_robot.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class WalkingPegasus : public testing::Test {
 protected:
  std::string complaint(const std::string& from, const std::string& to) const {
    return folder_.complaint(test::replaced(text_, from, to));
  }
  std::string line(const std::string& part) const {
    return "robot.yaml:" + std::to_string(test::line_of(text_, part)) + ":";
  }
  /// With one more gait, named odd.
  std::string with_gait(const std::string& gait) const {
    return complaint("gaits:\n", "gaits:\n  odd: {" + gait + "}\n");
  }
  RobotConfig with(const std::string& gait) const {
    return folder_.load(test::replaced(text_, "gaits:\n", "gaits:\n  odd: {" + gait + "}\n"));
  }

  test::RobotFolder folder_;
  const std::string text_ = test::shipped_yaml("pegasus");
};

std::string gait(const std::string& duty, const std::string& offsets, const std::string& to = "[]") {
  return "period: 0.5 s, duty: " + duty + ", offsets: " + offsets +
         ", lift: 0.04 m, pre_stance: 0.2, sway: 0.01 m, "
         "fastest: {forward: 0.3 m/s, backward: 0.25 m/s, sideways: 0.2 m/s, turning: 0.1 rad/s}, to: " +
         to;
}

TEST_F(WalkingPegasus, GaitsAreData) {
  const GaitConfig odd = with(gait("0.75", "[0, 0.25, 0.5, 0.75]", "[trot, crawl]")).gaits[0];
  EXPECT_EQ(odd.name, "odd");
  EXPECT_DOUBLE_EQ(odd.period_s, 0.5);
  EXPECT_DOUBLE_EQ(odd.duty, 0.75);
  EXPECT_EQ(odd.offsets, (std::vector<double>{0, 0.25, 0.5, 0.75}));
  EXPECT_DOUBLE_EQ(odd.lift_m, 0.04);
  EXPECT_DOUBLE_EQ(odd.pre_stance, 0.2);
  EXPECT_DOUBLE_EQ(odd.sway_m, 0.01);
  EXPECT_DOUBLE_EQ(odd.fastest_forward_m_s, 0.3);
  EXPECT_DOUBLE_EQ(odd.fastest_backward_m_s, 0.25);
  EXPECT_DOUBLE_EQ(odd.fastest_sideways_m_s, 0.2);
  EXPECT_DOUBLE_EQ(odd.fastest_turning_rad_s, 0.1);
  EXPECT_EQ(odd.to, (std::vector<std::string>{"trot", "crawl"}));
}

TEST_F(WalkingPegasus, AGaitMayHaveAHeightOfItsOwn) {
  EXPECT_EQ(with(gait("0.75", "[0, 0.25, 0.5, 0.75]")).gaits[0].height_m, 0.0);
  EXPECT_EQ(with(gait("0.75", "[0, 0.25, 0.5, 0.75]") + ", height: 0.44 m").gaits[0].height_m, 0.44);
  EXPECT_THAT(complaint("height: 0.5 m,", "height: 0.5 kg,"), HasSubstr("height"));
}

TEST_F(WalkingPegasus, AGaitMayHaveAnApproachSpeedOfItsOwn) {
  EXPECT_EQ(with(gait("0.75", "[0, 0.25, 0.5, 0.75]")).gaits[0].approach_m_s, 0.0);
  EXPECT_EQ(with(gait("0.75", "[0, 0.25, 0.5, 0.75]") + ", approach_speed: 0.3 m/s").gaits[0].approach_m_s,
            0.3);
  EXPECT_THAT(complaint("approach_speed: 0.22 m/s,", "approach_speed: 0 m/s,"), HasSubstr("approach_speed"));
}

TEST_F(WalkingPegasus, ShippedGaitsAreStandCrawlWalkAndTrot) {
  std::vector<std::string> names;
  for (const GaitConfig& g : folder_.load(text_).gaits) names.push_back(g.name);
  EXPECT_EQ(names, (std::vector<std::string>{"stand", "crawl", "walk", "trot"}));
}

TEST_F(WalkingPegasus, BodyIsRead) {
  const BodyConfig body = folder_.load(text_).body;
  EXPECT_DOUBLE_EQ(body.mass_kg, 12.0);
  EXPECT_DOUBLE_EQ(body.inertia_kg_m2[1], 0.513);
  EXPECT_TRUE(body.imu);
  EXPECT_DOUBLE_EQ(body.imu_latency_s, 0.005);
  EXPECT_DOUBLE_EQ(body.fallen_tilt_rad, 0.7);
  EXPECT_DOUBLE_EQ(body.fallen_height_m, 0.25);
  EXPECT_TRUE(body.meets_falls);
}

TEST_F(WalkingPegasus, FallsThatAreNotToBeMetAreSaidSo) {
  std::string text = text_;
  text.insert(text.find("tilt: 0.7 rad"), "met: false, ");
  EXPECT_FALSE(folder_.load(text).body.meets_falls);
}

TEST_F(WalkingPegasus, RobotWithoutABodyOrGaitsHasNone) {
  const RobotConfig robot = test::pegasus_without_feet();
  EXPECT_EQ(robot.body.mass_kg, 0.0);
  EXPECT_TRUE(robot.gaits.empty());
}

TEST_F(WalkingPegasus, OffsetsAreOneForEachLeg) {
  const std::string why = with_gait(gait("0.75", "[0, 0.25, 0.5]"));
  EXPECT_THAT(why, AllOf(HasSubstr("robot.yaml:" + std::to_string(test::line_of(text_, "gaits:") + 1)),
                         HasSubstr("gaits.odd.offsets"), HasSubstr("each of 4 legs, found 3")));
}

TEST_F(WalkingPegasus, GaitThatLeavesFewerThanTwoFeetOnTheGroundIsRefused) {
  const std::string at_gaits = "robot.yaml:" + std::to_string(test::line_of(text_, "gaits:") + 1);
  EXPECT_THAT(with_gait(gait("0.9", "[0, 0, 0, 0]")),
              AllOf(HasSubstr(at_gaits), HasSubstr("only 0 feet stand"), HasSubstr("needs 2")));
  EXPECT_THAT(with_gait(gait("0.45", "[0, 0.5, 0.5, 0]")),
              AllOf(HasSubstr(at_gaits), HasSubstr("only 0 feet stand at phase 0")));
  EXPECT_THAT(with_gait(gait("0.6", "[0, 0.2, 0.4, 0.9]")),
              AllOf(HasSubstr(at_gaits), HasSubstr("only 1 feet")));
}

TEST_F(WalkingPegasus, GaitAtTheEdgeOfWhatCanBeWalkedIsTaken) {
  EXPECT_EQ(with(gait("0.5", "[0, 0.5, 0.5, 0]")).gaits.size(), 5u);
  EXPECT_EQ(with(gait("1", "[0, 0, 0, 0]")).gaits.size(), 5u);
}

TEST_F(WalkingPegasus, NumbersThatCannotBeAreNamedWithTheirValue) {
  EXPECT_THAT(with_gait(gait("0.3", "[0, 0.5, 0.5, 0]")), AllOf(HasSubstr("duty"), HasSubstr("0.3")));
  EXPECT_THAT(with_gait(gait("0.6", "[0, 0.5, 1.5, 0]")), AllOf(HasSubstr("offsets"), HasSubstr("1.5")));
  EXPECT_THAT(complaint("period: 3.6 s", "period: 0.01 s"),
              AllOf(HasSubstr(line("period: 3.6 s")), HasSubstr("gaits.crawl.period"), HasSubstr("0.01")));
  EXPECT_THAT(complaint("period: 3.6 s", "period: 3.6"),
              AllOf(HasSubstr(line("period: 3.6 s")), HasSubstr("period")));
  EXPECT_THAT(complaint("fallen: {tilt: 0.7 rad", "fallen: {tilt: 0 rad"),
              AllOf(HasSubstr(line("fallen: {tilt: 0.7 rad")), HasSubstr("tilt")));
  EXPECT_THAT(complaint("approach_speed: 0.2 m/s", "approach_speed: 0 m/s"),
              AllOf(HasSubstr(line("approach_speed: 0.2 m/s")), HasSubstr("walk.approach_speed")));
}

TEST_F(WalkingPegasus, TransitionToAGaitThatThereIsNotIsRefused) {
  EXPECT_THAT(with_gait(gait("0.75", "[0, 0.25, 0.5, 0.75]", "[trot, gallop]")),
              AllOf(HasSubstr("robot.yaml:"), HasSubstr("odd"), HasSubstr("no gait 'gallop'")));
}

TEST_F(WalkingPegasus, UnknownAndMissingKeysAreNamed) {
  EXPECT_THAT(complaint("sway: 0.1 m,", ""), HasSubstr("sway' is missing"));
  EXPECT_THAT(complaint("sway: 0.1 m,", "sway: 0.1 m, bounce: 1,"), HasSubstr("bounce' is unknown"));
  EXPECT_THAT(complaint("  imu: true", "  imu: perhaps"), HasSubstr("imu"));
}

TEST_F(WalkingPegasus, PresetsLawOfWalkingIsRead) {
  const WalkConfig paper = folder_.load(text_).preset("paper").walk;
  EXPECT_EQ(paper.stance.stiffness_N_m, (std::array<double, 3>{625, 625, 3000}));  // [S1]
  EXPECT_EQ(paper.stance.damping_N_s_m, (std::array<double, 3>{10, 10, 10}));
  EXPECT_FALSE(paper.distribute_force);
  const WalkConfig best = folder_.load(text_).preset("best").walk;
  EXPECT_TRUE(best.distribute_force);
  EXPECT_GT(best.force_rise_s, 0.0);
}

class WithImuDriver : public WalkingPegasus {
 protected:
  static std::string driver(const std::string& device = "/dev/ttyUSB0", const std::string& baud = "460800") {
    return "imu_driver: {device: " + device + ", baud: " + baud +
           ", mounting: {roll: 3.14159 rad, pitch: 0 rad, yaw: -1.5708 rad}, latency: 2 ms, rate_range: 34 "
           "rad/s, "
           "force_range: 150 m/s^2, longest_silence: 20 ms}";
  }
  std::string complaint_about(const std::string& text) const {
    return complaint("imu: true,", "imu: true, " + text + ",");
  }
};

TEST_F(WithImuDriver, SaysLineMountingAndRanges) {
  const BodyConfig body = folder_.load(test::replaced(text_, "imu: true,", "imu: true, " + driver() + ","))
                              .body;
  EXPECT_EQ(body.imu_driver.device, "/dev/ttyUSB0");
  EXPECT_EQ(body.imu_driver.baud, 460800);
  EXPECT_DOUBLE_EQ(body.imu_driver.mounting_yaw_rad, -1.5708);
  EXPECT_DOUBLE_EQ(body.imu_driver.latency_s, 0.002);
  EXPECT_DOUBLE_EQ(body.imu_driver.range_rad_s, 34.0);
  EXPECT_DOUBLE_EQ(body.imu_driver.longest_silence_s, 0.020);
  EXPECT_TRUE(load_robot("pegasus").body.imu_driver.device.empty());
}

TEST_F(WithImuDriver, WhatNoLineCanBeIsRefused) {
  EXPECT_THAT(complaint_about(driver("ttyUSB0")), AllOf(HasSubstr("device"), HasSubstr("/dev/ttyUSB0")));
  EXPECT_THAT(complaint_about(driver("/dev/ttyUSB0", "12345")),
              AllOf(HasSubstr("baud"), HasSubstr("115200")));
  EXPECT_THAT(complaint("imu: true,", "imu: false, " + driver() + ","), HasSubstr("imu: false"));
}

}  // namespace
}  // namespace sprung
