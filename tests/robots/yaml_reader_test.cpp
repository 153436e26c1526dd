#include "robots/yaml_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

YamlMap parse(const std::string& text) { return YamlMap::parse(text, "test.yaml"); }

template <class Action>
std::string complaint(Action action) {
  try {
    action();
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(YamlReader, QuantityIsReadWithItsUnit) {
  EXPECT_DOUBLE_EQ(parse("mass: 4.13 kg").quantity("mass", "kg", 0, 10), 4.13);
  EXPECT_DOUBLE_EQ(parse("ratio: 100").quantity("ratio", "", 0, 1000), 100.0);
  EXPECT_DOUBLE_EQ(parse("w: -1e-2 kg m^2").quantity("w", "kg m^2", -1, 1), -0.01);
}

TEST(YamlReader, MillisecondsAreSeconds) {
  EXPECT_DOUBLE_EQ(parse("t: 20 ms").quantity("t", "s", 0, 1), 0.020);
}

TEST(YamlReader, MissingKeyIsNamedWithFileAndLine) {
  EXPECT_THAT(complaint([] { (void)parse("a: 1").quantity("b", "", 0, 1); }),
              AllOf(HasSubstr("test.yaml:1"), HasSubstr("'b' is missing")));
}

TEST(YamlReader, MissingUnitIsRefused) {
  EXPECT_THAT(complaint([] { (void)parse("a: 1\nmass: 4.13").quantity("mass", "kg", 0, 10); }),
              AllOf(HasSubstr("test.yaml:2"), HasSubstr("unit is missing"), HasSubstr("'kg'")));
}

TEST(YamlReader, WrongUnitIsRefused) {
  EXPECT_THAT(complaint([] { (void)parse("torque: 3 N").quantity("torque", "Nm", 0, 10); }),
              AllOf(HasSubstr("wrong unit 'N'"), HasSubstr("'Nm'")));
  EXPECT_THAT(complaint([] { (void)parse("ratio: 3 N").quantity("ratio", "", 0, 10); }),
              HasSubstr("wrong unit 'N'"));
}

TEST(YamlReader, OutOfRangeIsRefusedWithTheRange) {
  EXPECT_THAT(complaint([] { (void)parse("mass: -1 kg").quantity("mass", "kg", 0, 10); }),
              AllOf(HasSubstr("out of range"), HasSubstr("0 to 10 kg")));
}

TEST(YamlReader, WhatIsNoNumberIsRefused) {
  for (const char* text : {"a: x", "a: nan kg", "a: inf kg", "a: 3kg", "a: [1, 2]", "a: ''"}) {
    EXPECT_THAT(complaint([&] { (void)parse(text).quantity("a", "kg", 0, 10); }), HasSubstr("expected"))
        << text;
  }
}

TEST(YamlReader, UnknownKeyIsRefusedWithTheKnownOnes) {
  const YamlMap map = parse("a: 1\nzz: 2");
  (void)map.quantity("a", "", 0, 1);
  EXPECT_THAT(complaint([&] { map.finish(); }),
              AllOf(HasSubstr("test.yaml:2"), HasSubstr("'zz' is unknown"), HasSubstr("known here: a")));
}

TEST(YamlReader, KeyThatStandsTwiceIsRefused) {
  EXPECT_THAT(complaint([] { (void)parse("a: 1\na: 2\n"); }), HasSubstr("test.yaml:2: key 'a' stands twice"));
}

TEST(YamlReader, TheNearestKeyIsNamedBesideAllThatAreKnown) {
  const YamlMap map = parse("stand_lenght: 0.5 m\n");
  (void)map.has("sit_length");
  (void)map.has("stand_length");
  EXPECT_THAT(
      complaint([&] { map.finish(); }),
      HasSubstr("test.yaml:1: key 'stand_lenght' is unknown; did you mean 'stand_length'?; known here: "
                "sit_length, stand_length"));
}

TEST(YamlReader, WhatOneEntryLacksIsNamedWithWhatTheEntryIs) {
  const YamlMap map = parse("mirror: {leg: l, left_right: r}\nj:\n  - {name: l_hip, a: 1}\n");
  EXPECT_THAT(complaint([&] { (void)map.list("j")[1].integer("b", 0, 9); }),
              HasSubstr("test.yaml:3: key 'j[1].b' is missing (in r_hip, mirror image of l_hip)"));
}

TEST(YamlReader, AMistakeInWhatAllHaveInCommonIsWhereItWasTyped) {
  const YamlMap map = parse("j:\n  - all: {a: 1 kg}\n  - {name: p}\n");
  EXPECT_THAT(complaint([&] { (void)map.list("j")[0].quantity("a", "m", 0, 9); }),
              HasSubstr("test.yaml:2: key 'j[0].a': wrong unit 'kg'"));
}

TEST(YamlReader, EveryValueHasAPlace) {
  const YamlMap map = parse("robot: x\njoints:\n  - {name: hip,\n     a: 1, m: {b: [4,\n 5]}}\n");
  EXPECT_EQ(map.place("joints[0].a"), "test.yaml:4");
  EXPECT_EQ(map.place("joints[hip].a"), "test.yaml:4");
  EXPECT_EQ(map.place("joints[hip].m.b[1]"), "test.yaml:5");
  EXPECT_EQ(map.place("joints[hip].m.power"), "test.yaml:4") << "not there: its map";
  EXPECT_EQ(map.place("nothing"), "test.yaml:1");
}

TEST(YamlReader, WhatIsNotThereIsRememberedWithWhatWasTakenInstead) {
  const YamlMap map = parse("l: [{a: 1}]");
  const YamlMap entry = map.list("l")[0];
  entry.quantity_or("power", "W", 0, 9, 0.5);
  entry.integer_or("poles", 0, 9, 7);
  (void)entry.has("thermal");
  entry.integer_or("a", 0, 9, 3);
  const auto& defaults = map.questions().defaults;
  ASSERT_EQ(defaults.size(), 1u);
  EXPECT_THAT(defaults.at("l[0]."),
              testing::ElementsAre(testing::Pair("poles", "7"), testing::Pair("power", "0.5 W"),
                                   testing::Pair("thermal", "")));
}

TEST(YamlReader, NestedKeysAreNamedByTheirPath) {
  EXPECT_THAT(complaint([] { (void)parse("legs:\n  - {name: x}").list("legs")[0].text("kinematics"); }),
              HasSubstr("'legs[0].kinematics' is missing"));
}

TEST(YamlReader, IntegersMayBeHexadecimal) {
  EXPECT_EQ(parse("v: 0x9A").integer("v", 0, 255), 0x9A);
  EXPECT_THAT(complaint([] { (void)parse("v: 1.5").integer("v", 0, 255); }), HasSubstr("whole number"));
  EXPECT_THAT(complaint([] { (void)parse("v: 256").integer("v", 0, 255); }), HasSubstr("out of range"));
}

TEST(YamlReader, FlagsAreTrueOrFalse) {
  EXPECT_TRUE(parse("f: true").flag("f"));
  EXPECT_THAT(complaint([] { (void)parse("f: yes").flag("f"); }), HasSubstr("true or false"));
}

TEST(YamlReader, BrokenYamlNamesTheLine) {
  EXPECT_THAT(complaint([] { (void)parse("a: 1\nb: [1, 2"); }), HasSubstr("no YAML"));
  EXPECT_THAT(complaint([] { (void)parse("- 1\n- 2"); }), HasSubstr("map of keys"));
  EXPECT_THAT(complaint([] { (void)YamlMap::load("/nowhere/robot.yaml"); }), HasSubstr("cannot be read"));
}

TEST(YamlReader, MatrixRowsMustBeLists) {
  EXPECT_EQ(parse("m: [[1, 0], [0.01, 1]]").matrix("m", -1, 1)[1][0], 0.01);
  EXPECT_THAT(complaint([] { (void)parse("m: [1, 0]").matrix("m", -1, 1); }), HasSubstr("list of rows"));
}

TEST(YamlReader, ANumberAnywhereBelowIsFoundByItsPath) {
  const YamlMap map = parse("gains: {stiffness: {x: 3 N/m}, curve: [0.1 m, 0.2 m]}\nname: leg");
  EXPECT_EQ(map.quantity_at("gains.stiffness.x"), std::make_pair(3.0, std::string("N/m")));
  EXPECT_EQ(map.quantity_at("gains.curve.1"), std::make_pair(0.2, std::string("m")));
  for (const char* path :
       {"gains", "gains.stiffness.y", "gains.curve.2", "gains.curve.x", "name", "name.x", ""})
    EXPECT_THAT(complaint([&] { (void)map.quantity_at(path); }), HasSubstr("no number")) << path;
}

TEST(YamlReader, ACopyWithAnotherNumberKeepsTheUnitAndTheOriginalStays) {
  const YamlMap map = parse("gains: {stiffness: {x: 3 N/m}, curve: [0.1 m, 0.2 m], share: 1}");
  const YamlMap changed = map.with_number_at("gains.stiffness.x", 0.1).with_number_at("gains.curve.0", 5);
  EXPECT_EQ(changed.map("gains").map("stiffness").quantity("x", "N/m", 0, 10), 0.1);
  EXPECT_EQ(changed.map("gains").quantities("curve", "m", 0, 10), (std::vector<double>{5.0, 0.2}));
  EXPECT_EQ(changed.with_number_at("gains.share", 0.5).map("gains").quantity("share", "", 0, 1), 0.5);
  EXPECT_EQ(map.map("gains").map("stiffness").quantity("x", "N/m", 0, 10), 3.0);
  EXPECT_THAT(complaint([&] { (void)map.with_number_at("gains.z", 1); }), HasSubstr("no number"));
}

TEST(YamlReader, NumbersThatWereAskedForAreKnownByTheirPathsThoseThatAreNotThereToo) {
  const YamlMap map = parse(
      "mass: 1 kg\nname: x\nlegs:\n  - {length: 0.3 m, node: 5, curve: [1, 2]}\nunread: 7");
  map.quantity("mass", "kg", 0, 10);
  map.text("name");
  const YamlMap leg = map.list("legs")[0];
  leg.quantity("length", "m", 0, 1);
  leg.integer("node", 0, 9);
  leg.quantities("curve", "", 0, 9);
  leg.quantity_or("power", "W", 0, 1, 0.0);
  leg.integer_or("poles", 0, 1, 0);
  EXPECT_THAT(map.questions().numbers, testing::ElementsAre("legs[0].curve", "legs[0].length", "legs[0].node",
                                                            "legs[0].poles", "legs[0].power", "mass"));
  EXPECT_EQ(leg.questions().numbers, map.questions().numbers);
}

}  // namespace
}  // namespace sprung
