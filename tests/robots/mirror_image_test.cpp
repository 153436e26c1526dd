#include "robots/mirror_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/config_error.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const MirrorImage kRight{"fl", "fr", true, false, 1};
const MirrorImage kHind{"fl", "hl", false, true, 1};
const MirrorImage kBoth{"fl", "hr", true, true, 1};

YamlTree image_of(const std::string& entry, const MirrorImage& image) {
  return mirrored(parse_yaml(entry, "r.yaml"), image, "r.yaml");
}

std::string image_complaint(const std::string& entry) {
  try {
    (void)image_of(entry, kRight);
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(MirrorImage, EveryWordOfTheLegIsOfTheOther) {
  const YamlTree tree = image_of(
      "{name: fl_hip, text: \"identify --log fl_hip.lcm fl xfl flu\", l: [fl_a, hl_b], n: 3 m}", kRight);
  EXPECT_EQ(tree.text_of("name"), "fr_hip");
  EXPECT_EQ(tree.text_of("text"), "identify --log fr_hip.lcm fr xfl flu");
  EXPECT_EQ(tree.find("l")->items[0].text, "fr_a");
  EXPECT_EQ(tree.find("l")->items[1].text, "hl_b");
  EXPECT_EQ(tree.text_of("n"), "3 m");
}

TEST(MirrorImage, ALegChangesSidesLeftToRightAndEndsFrontToHind) {
  const std::string leg = "{name: fl, side: left, hip_in_trunk: {x: 0.33 m, y: 0.12 m, z: 0.01 m}}";
  const auto said = [&](const MirrorImage& image) {
    const YamlTree tree = image_of(leg, image);
    const YamlTree& hip = *tree.find("hip_in_trunk");
    return tree.text_of("side") + " " + hip.text_of("x") + " " + hip.text_of("y") + " " + hip.text_of("z");
  };
  EXPECT_EQ(said(kRight), "right 0.33 m -0.12 m 0.01 m");
  EXPECT_EQ(said(kHind), "left -0.33 m 0.12 m 0.01 m");
  EXPECT_EQ(said(kBoth), "right -0.33 m -0.12 m 0.01 m");
}

TEST(MirrorImage, AMotorIsTurnedRoundWhereItSaysSo) {
  const auto direction = [](const char* flips, const MirrorImage& image) {
    return image_of(std::string("{name: fl_m, direction: 1") + flips + "}", image).text_of("direction");
  };
  EXPECT_EQ(direction("", kBoth), "1");
  EXPECT_EQ(direction(", flips: left_right", kRight), "-1");
  EXPECT_EQ(direction(", flips: left_right", kHind), "1");
  EXPECT_EQ(direction(", flips: left_right", kBoth), "-1");
  EXPECT_EQ(direction(", flips: front_hind", kRight), "1");
  EXPECT_EQ(direction(", flips: front_hind", kHind), "-1");
}

TEST(MirrorImage, ALinkEncoderThatIsTurnedRoundCountsFromItsOtherEnd) {
  const auto encoder = [](const std::string& direction, const std::string& offset) {
    const YamlTree tree = image_of("{name: fl_m, flips: left_right, link_encoder: {direction: " + direction +
                                       ", offset: " + offset + "}}",
                                   kRight);
    return tree.find("link_encoder")->text_of("direction") + " " +
           tree.find("link_encoder")->text_of("offset");
  };
  EXPECT_EQ(encoder("-1", "4.8416 rad"), "1 -1.4416 rad");
  EXPECT_EQ(encoder("1", "-1.4416 rad"), "-1 4.8416 rad");
  EXPECT_EQ(encoder("-1", "3 rad"), "1 -3.2832 rad");
  EXPECT_EQ(encoder("-1", "3.14159265 rad"), "1 -3.14159266 rad");
}

TEST(MirrorImage, AJointsAnglesChangeSignWhereItSaysSo) {
  const YamlTree tree = image_of(
      "{name: fl_a, flips: left_right, position: {min: -0.6 rad, max: 0.5 rad}, stops: {min: -0.65 rad, max: "
      "0 rad}, "
      "initial: 0.0 rad, lying: 0.58 rad}",
      kRight);
  EXPECT_EQ(tree.find("position")->text_of("min"), "-0.5 rad");
  EXPECT_EQ(tree.find("position")->text_of("max"), "0.6 rad");
  EXPECT_EQ(tree.find("stops")->text_of("min"), "0 rad");
  EXPECT_EQ(tree.find("stops")->text_of("max"), "0.65 rad");
  EXPECT_EQ(tree.text_of("initial"), "0.0 rad");
  EXPECT_EQ(tree.text_of("lying"), "-0.58 rad");
}

TEST(MirrorImage, WhatCannotBeTurnedRoundIsRefusedWithItsLine) {
  EXPECT_THAT(image_complaint("name: fl_m\nflips: left_right\ndirection: forward"),
              AllOf(HasSubstr("r.yaml:3"), HasSubstr("'forward'")));
  EXPECT_THAT(image_complaint("name: fl_m\nflips: sideways"),
              AllOf(HasSubstr("r.yaml:2"), HasSubstr("left_right or")));
}

std::string mirror_complaint(const std::string& text) {
  try {
    YamlTree tree = parse_yaml(text, "r.yaml");
    (void)take_mirror(tree, "r.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(MirrorImage, TheKeyIsTakenOutOfTheFile) {
  YamlTree tree = parse_yaml("robot: x\nmirror: {leg: fl, left_right: fr, both: hr}\n", "r.yaml");
  const auto images = take_mirror(tree, "r.yaml");
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[1].of + images[1].leg, "flhr");
  EXPECT_TRUE(images[1].left_right && images[1].front_hind);
  EXPECT_FALSE(images[0].front_hind);
  EXPECT_EQ(images[0].line, 2);
  EXPECT_EQ(tree.find("mirror"), nullptr);
  EXPECT_TRUE(take_mirror(tree, "r.yaml").empty());
}

TEST(MirrorImage, MistakesOfTheKeyAreNamed) {
  EXPECT_THAT(mirror_complaint("mirror: fl"), HasSubstr("r.yaml:1: key 'mirror': expected {leg: NAME"));
  EXPECT_THAT(mirror_complaint("mirror: {leg: fl, right: fr}"),
              AllOf(HasSubstr("key 'mirror.right' is unknown"), HasSubstr("left_right, front_hind, both")));
  EXPECT_THAT(mirror_complaint("mirror: {leg: fl, both: [hr]}"), HasSubstr("expected a leg's name"));
}

}  // namespace
}  // namespace sprung
