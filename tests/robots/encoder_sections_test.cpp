/// Encoder cards, link encoders, references, bit rate and joints alone, on the shipped pegasus and after one
/// mistake each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "robots/robot_loader.h"
#include "robots/robot_sections.h"
#include "tests/support/changed_robot.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ChangedPegasus : public testing::Test {
 protected:
  RobotConfig changed(const std::string& from, const std::string& to) const {
    return folder_.load(test::replaced(text_, from, to));
  }
  std::string complaint(const std::string& from, const std::string& to) const {
    return folder_.complaint(test::replaced(text_, from, to));
  }

  /// To one entry of those that are typed by `all` or a mirror.
  std::string typed_out_complaint(const std::string& from, const std::string& to) const {
    return folder_.complaint(test::replaced(test::typed_out_yaml("pegasus"), from, to));
  }

  test::RobotFolder folder_;
  std::string text_ = test::shipped_yaml("pegasus");
};

TEST(Pegasus, HasTwelveDrivesAndFourCardsOnFourBuses) {
  const RobotConfig robot = load_robot("pegasus");
  EXPECT_DOUBLE_EQ(robot.cycle_s, 0.002);
  EXPECT_DOUBLE_EQ(robot.bit_rate_bit_s, 1e6);
  ASSERT_EQ(robot.buses.size(), 4u);
  ASSERT_EQ(robot.actuators.size(), 12u);
  ASSERT_EQ(robot.encoder_cards.size(), 4u);
  std::set<std::string> addresses;
  for (const BusConfig& bus : robot.buses) addresses.insert(bus.can);
  EXPECT_EQ(addresses.size(), 4u);
  for (std::size_t i = 0; i < 12; ++i) {
    const ActuatorConfig& a = robot.actuators[i];
    EXPECT_EQ(a.bus, static_cast<int>(i / 3)) << a.name;
    EXPECT_EQ(a.profile, "epos2");
    EXPECT_EQ(a.identity.vendor, 0xFBu);
    EXPECT_EQ(a.pole_pairs, 12);
    EXPECT_DOUBLE_EQ(a.winding_time_constant_s, 52.6);
    EXPECT_EQ(a.link_encoder.card, a.bus);
    EXPECT_EQ(a.link_encoder.channel, static_cast<int>(i % 3));
    EXPECT_EQ(a.reference.method, ReferenceMethod::kLink);
    EXPECT_FALSE(a.reference.absolute_encoder);
    EXPECT_FALSE(a.referenced);
  }
}

TEST(Pegasus, LinkEncodersDoNotWrapWithinTheJointsLimits) {
  const RobotConfig robot = load_robot("pegasus");
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const LinkEncoderConfig& encoder = robot.actuators[i].link_encoder;
    const double turn_rad = 2.0 * std::acos(-1.0);
    const double end_rad = encoder.offset_rad + encoder.direction * turn_rad;
    EXPECT_LT(std::min(encoder.offset_rad, end_rad), robot.joints[i].position_min_rad)
        << robot.joints[i].name;
    EXPECT_GT(std::max(encoder.offset_rad, end_rad), robot.joints[i].position_max_rad)
        << robot.joints[i].name;
    EXPECT_LT(robot.joints[i].position_max_rad, 0.5 * turn_rad);
  }
}

TEST(Pegasus, HasFeetToStandOn) {
  const RobotConfig robot = load_robot("pegasus");
  EXPECT_TRUE(robot.has_feet());
  EXPECT_EQ(robot.legs[3].joints, (std::vector<int>{9, 10, 11}));
  EXPECT_EQ(robot.preset("best").name, "best");
}

TEST(PegasusWithoutFeet, LegsAreJointsAloneAndNeedNoPresets) {
  const RobotConfig robot = test::pegasus_without_feet();
  EXPECT_FALSE(robot.has_feet());
  EXPECT_STREQ(robot.why_not_standing(), "this robot's legs have no kinematics: it cannot stand");
  EXPECT_TRUE(robot.legs[3].links.empty());
  EXPECT_EQ(robot.legs[3].joints, (std::vector<int>{9, 10, 11}));
  EXPECT_EQ(robot.preset("best").name, "none");
}

TEST(TestAxis, HasAnArmThatNothingStandsOnAndNeedsNoPresets) {
  const RobotConfig robot = load_robot("test_axis");
  EXPECT_FALSE(robot.has_feet());
  EXPECT_STREQ(robot.why_not_standing(), "this robot has an arm where legs would be: it cannot stand");
  EXPECT_EQ(robot.legs[0].kinematics, kOneLink);
  EXPECT_EQ(robot.legs[0].links.size(), 1U);
  EXPECT_EQ(robot.preset("best").name, "none");
  EXPECT_EQ(robot.joints[0].coulomb_friction_Nm, 1.79)
      << "the paper's until it is identified, never the plant's";
}

TEST(SingleLeg, HasFeetAndTheDefaultBitRate) {
  const RobotConfig robot = load_robot("single_leg");
  EXPECT_TRUE(robot.has_feet());
  EXPECT_EQ(robot.why_not_standing(), nullptr);
  EXPECT_DOUBLE_EQ(robot.bit_rate_bit_s, 1e6);
  EXPECT_EQ(robot.actuators[0].link_encoder.card, -1);
  EXPECT_EQ(robot.actuators[0].reference.method, ReferenceMethod::kNone);
  EXPECT_EQ(robot.actuators[0].pole_pairs, 0);
}

TEST_F(ChangedPegasus, BitRatesAreTheStandardOnes) {
  EXPECT_DOUBLE_EQ(changed("bit_rate: 1000 kbit/s", "bit_rate: 500 kbit/s").bit_rate_bit_s, 5e5);
  EXPECT_DOUBLE_EQ(changed("bit_rate: 1000 kbit/s", "").bit_rate_bit_s, 1e6);
  EXPECT_THAT(complaint("bit_rate: 1000 kbit/s", "bit_rate: 999 kbit/s"),
              AllOf(HasSubstr("robot.yaml:" + std::to_string(test::line_of(text_, "bit_rate:"))),
                    HasSubstr("1000, 800, 500, 250 or 125 kbit/s")));
  EXPECT_THAT(complaint("bit_rate: 1000 kbit/s", "bit_rate: 1 Mbit/s"), HasSubstr("wrong unit 'Mbit/s'"));
}

TEST_F(ChangedPegasus, CardOnADrivesNodeIdIsRefused) {
  EXPECT_THAT(complaint("name: fl_card, bus: fl, node: 4", "name: fl_card, bus: fl, node: 3"),
              AllOf(HasSubstr("fl_knee_motor and fl_card share node id 3"), HasSubstr("bus fl")));
  EXPECT_THAT(complaint("encoder_cards:", "encoder_cards:\n  - {name: fr_card, bus: fl}"),
              HasSubstr("fl_card and fr_card share node id 4"));
}

TEST_F(ChangedPegasus, MistakesOfCardsAreRefused) {
  EXPECT_THAT(
      complaint("encoder_cards:",
                "encoder_cards:\n  - {name: hl_card, like: fl_card}\n  - {name: hl_card, like: fl_card}"),
      HasSubstr("'hl_card' stands twice"));
  EXPECT_THAT(complaint("bus: fl, node: 4", "bus: arm, node: 4"), HasSubstr("'arm' is not known"));
  EXPECT_THAT(complaint("node: 4, profile: encoder_card", "node: 4"), HasSubstr("profile' is missing"));
  EXPECT_THAT(complaint("node: 4, profile", "node: 127, profile"), HasSubstr("out of range"));
}

TEST_F(ChangedPegasus, MistakesOfLinkEncodersAreRefused) {
  EXPECT_THAT(complaint("card: fl_card, channel: 0", "card: arm, channel: 0"),
              AllOf(HasSubstr("'arm' is not known"), HasSubstr("fl_card, fr_card")));
  EXPECT_THAT(complaint("card: fl_card, channel: 0", "card: fl_card, channel: 4"), HasSubstr("out of range"));
  EXPECT_THAT(complaint("card: fl_card, channel: 1", "card: fl_card, channel: 0"),
              HasSubstr("fl_abduction_motor and fl_hip_motor share channel 0 of encoder card fl_card"));
  EXPECT_THAT(complaint("counts: 1048576, direction: -1", "counts: 1048576, direction: 0"),
              HasSubstr("link_encoder.direction': expected 1 or -1"));
  EXPECT_THAT(complaint("offset: 3.1416 rad}", "offset: 3.1416}"), HasSubstr("unit is missing"));
  EXPECT_THAT(complaint("offset: 3.1416 rad}", "offset: 3.1416 rad, bits: 20}"),
              HasSubstr("bits' is unknown"));
}

// The bridge knows a link position within half a turn either way of zero.
TEST_F(ChangedPegasus, JointThatTurnsPastHalfATurnCannotHaveALinkEncoder) {
  EXPECT_THAT(complaint("max: 3.0 rad", "max: 3.15 rad"),
              AllOf(HasSubstr("actuator fl_hip_motor"), HasSubstr("from 0.4 to 3.15 rad"),
                    HasSubstr("link_encoder")));
  EXPECT_THAT(complaint("min: -0.6 rad", "min: -3.2 rad"), HasSubstr("from -3.2 to 0.6 rad"));
  EXPECT_EQ(complaint("max: 3.0 rad", "max: 3.14 rad"), "nothing was refused");
}

TEST_F(ChangedPegasus, RangeOfALinkEncoderIsTheActuatorsNotTheJoints) {
  // Knee driven from the body: its joint is actuator 2 less actuator 1, so the actuator turns by both ranges.
  EXPECT_THAT(complaint("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "[[1, 0, 0], [0, 1, 0], [0, -1, 1]]"),
              AllOf(HasSubstr("actuator fl_knee_motor"), HasSubstr("from 0.5 to 5.5 rad")));
  EXPECT_EQ(complaint("[[1, 0, 0], [0, 1, 0], [0, 0, 1]]", "[[1, 0, 0], [0, 1, 0], [0, 1, 1]]"),
            "nothing was refused");
}

TEST(Pegasus, JointWithoutALinkEncoderMayTurnFurther) {
  const YamlMap file = YamlMap::parse("actuators: none", "robot.yaml");
  RobotConfig robot = load_robot("pegasus");
  robot.joints[1].position_max_rad = 9.0;
  EXPECT_THROW(robot_sections::refuse_folded_link_positions(file, robot), ConfigError);
  robot.actuators[1].link_encoder.card = -1;
  EXPECT_NO_THROW(robot_sections::refuse_folded_link_positions(file, robot));
}

class ChangedReference : public ChangedPegasus {
 protected:
  static constexpr const char* kShipped = "reference: {method: link, encoder: incremental}";
  ReferenceConfig read(const std::string& to) {
    return changed(kShipped, "reference: " + to).actuators[0].reference;
  }
  std::string refusal(const std::string& to) { return complaint(kShipped, "reference: " + to); }
};

TEST_F(ChangedReference, EveryMethodTakesWhatItNeeds) {
  EXPECT_EQ(read("{method: none, encoder: absolute}").method, ReferenceMethod::kNone);
  const ReferenceConfig jig = read("{method: jig, encoder: absolute, jig: 1.5 rad}");
  EXPECT_EQ(jig.method, ReferenceMethod::kJig);
  EXPECT_TRUE(jig.absolute_encoder);
  EXPECT_EQ(jig.jig_position_rad, 1.5);
  const ReferenceConfig index = read("{method: index, encoder: incremental, jig: 1.5 rad, index: 0.01 rad}");
  EXPECT_EQ(index.method, ReferenceMethod::kIndex);
  EXPECT_EQ(index.index_position_rad, 0.01);
}

TEST_F(ChangedReference, WhatAMethodLacksOrDoesNotUseIsRefused) {
  EXPECT_THAT(refusal("{method: jig, encoder: absolute}"), HasSubstr("reference.jig' is missing"));
  EXPECT_THAT(refusal("{method: index, encoder: absolute, jig: 0 rad}"),
              HasSubstr("reference.index' is missing"));
  EXPECT_THAT(refusal("{method: link, encoder: absolute, jig: 0 rad}"), HasSubstr("jig' is unknown"));
  EXPECT_THAT(refusal("{method: guess, encoder: absolute}"), HasSubstr("none, link, index, jig"));
  EXPECT_THAT(refusal("{method: link, encoder: magic}"), HasSubstr("absolute, incremental"));
}

TEST_F(ChangedReference, AnIncrementalEncoderNeedsAMethod) {
  EXPECT_THAT(refusal("{method: none, encoder: incremental}"),
              AllOf(HasSubstr("link, index or jig"), HasSubstr(":")));
}

TEST_F(ChangedPegasus, AnIncrementalEncoderCannotBeReferencedByFile) {
  EXPECT_THAT(
      complaint("referenced: false", "referenced: true"),
      AllOf(HasSubstr("actuators[0].referenced'"), HasSubstr("say false here"), HasSubstr("sprung home")));
}

TEST_F(ChangedPegasus, ADateWithoutAZeroOfTheFileIsRefused) {
  EXPECT_THAT(complaint("referenced: false", "referenced_on: 2026-11-21, referenced: false"),
              AllOf(HasSubstr("referenced_on"), HasSubstr("`referenced` is false")));
}

TEST_F(ChangedPegasus, MethodLinkNeedsALinkEncoder) {
  EXPECT_THAT(
      typed_out_complaint("    link_encoder: {counts: 1048576, direction: -1, card: fl_card, channel: 0, "
                          "offset: 3.1416 rad}\n",
                          ""),
      AllOf(HasSubstr("actuators[0].reference'"), HasSubstr("needs a link_encoder")));
}

TEST_F(ChangedPegasus, MotorDataOutOfRangeAreRefused) {
  EXPECT_THAT(complaint("pole_pairs: 12", "pole_pairs: 0"), HasSubstr("out of range"));
  EXPECT_THAT(complaint("winding_time_constant: 52.6 s", "winding_time_constant: 0 s"),
              HasSubstr("out of range"));
}

TEST_F(ChangedPegasus, JointsAloneHaveNoLinksAndLegsWithFeetNeedPresets) {
  const std::string shipped = text_;
  text_ = test::without_feet(shipped);
  EXPECT_THAT(complaint("kinematics: none", "kinematics: none\n    links: []"),
              HasSubstr("links' is unknown"));
  EXPECT_THAT(complaint("kinematics: none", "kinematics: two_link"), HasSubstr("links' is missing"));
  text_ = shipped;
  EXPECT_THAT(complaint(shipped.substr(shipped.find("presets:"),
                                       shipped.find("processes:") - shipped.find("presets:")),
                        ""),
              HasSubstr("presets' is missing"));
}

TEST_F(ChangedPegasus, JointsOutsideOfLegsAreToldOfJointsAlone) {
  EXPECT_THAT(
      complaint("    joints: [fl_abduction, fl_hip, fl_knee]", "    joints: [fl_hip, fl_hip, fl_knee]"),
      AllOf(HasSubstr("fl_abduction"), HasSubstr("kinematics: none")));
}

TEST_F(ChangedPegasus, NodesAreWatchedByHeartbeatUnlessTheFileSaysGuarding) {
  for (const ActuatorConfig& a : load_robot("pegasus").actuators) EXPECT_EQ(a.watch, NodeWatch::kHeartbeat);
  const RobotConfig guarded = changed("profile: encoder_card,", "profile: encoder_card, watch: guarding,");
  EXPECT_EQ(guarded.encoder_cards[0].watch, NodeWatch::kGuarding);
  EXPECT_EQ(changed("profile: epos2,", "profile: epos2, watch: guarding,").actuators[0].watch,
            NodeWatch::kGuarding);
  EXPECT_EQ(changed("profile: epos2,", "profile: epos2, watch: heartbeat,").actuators[0].watch,
            NodeWatch::kHeartbeat);
  EXPECT_THAT(complaint("profile: epos2,", "profile: epos2, watch: polling,"),
              AllOf(HasSubstr("watch"), HasSubstr("heartbeat"), HasSubstr("guarding")));
}

}  // namespace
}  // namespace sprung
