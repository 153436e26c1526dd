#include "robots/yaml_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/config_error.h"
#include "tests/support/refusal.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::string tree_complaint(const std::string& text) {
  try {
    (void)parse_yaml(text, "r.yaml");
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(YamlTree, EveryValueAndKeyKnowsItsLine) {
  const YamlTree tree = parse_yaml("a: 1\nb:\n  - {name: x, c: 2 m}\n  - \"quoted\"\n", "r.yaml");
  EXPECT_EQ(tree.keys[1].line, 2);
  const YamlTree& list = *tree.find("b");
  EXPECT_TRUE(list.is_list());
  EXPECT_EQ(list.items[0].line, 3);
  EXPECT_EQ(list.items[0].find("c")->text, "2 m");
  EXPECT_FALSE(list.items[0].find("c")->quoted);
  EXPECT_TRUE(list.items[1].quoted);
  EXPECT_EQ(list.items[1].line, 4);
  EXPECT_EQ(tree.find("z"), nullptr);
}

TEST(YamlTree, EntriesAreCalledByTheirNameActuatorOrCard) {
  for (const char* key : {"name", "actuator", "card"})
    EXPECT_EQ(parse_yaml(std::string("{x: 1, ") + key + ": fl}", "r.yaml").name(), "fl") << key;
  EXPECT_EQ(parse_yaml("{x: 1}", "r.yaml").name(), "");
}

TEST(YamlTree, AnAliasIsWhatItsAnchorIsAndIsOfItsLine) {
  const YamlTree tree = parse_yaml("a: &x {b: 1}\nc: *x\n", "r.yaml");
  EXPECT_EQ(tree.find("c")->find("b")->text, "1");
  EXPECT_EQ(tree.find("c")->find("b")->line, 1);
}

TEST(YamlTree, MergeKeysAreRefusedAsSuchWithTheRemedy) {
  EXPECT_THAT(tree_complaint("a: &j {b: 1}\nc:\n  <<: *j\n  d: 2\n"),
              AllOf(HasSubstr("r.yaml:3: key 'c.<<'"), HasSubstr("merge keys are not read"),
                    HasSubstr("`like: NAME`"), HasSubstr("`all:`")));
}

TEST(YamlTree, WhatIsNoTreeIsRefused) {
  EXPECT_THAT(tree_complaint("a:\n  b: 1\n  b: 2\n"), HasSubstr("r.yaml:3: key 'a.b' stands twice"));
  EXPECT_THAT(tree_complaint("a: [1,\nb: }"), HasSubstr("no YAML"));
  EXPECT_THAT(tree_complaint("a: &x [*x]"), HasSubstr("anchor"));
  EXPECT_THAT(tree_complaint("? [a, b]\n: 1\n"), HasSubstr("expected a word"));
}

/// Made by hand while the fuzz target was written: these eight lines are 400 million values, and a log's
/// robot.yaml comes from anybody.
TEST(YamlTree, AnchorsThatRepeatAnchorsAreRefused) {
  std::string text = "a: &a [x, x, x, x, x, x, x, x, x]\n";
  for (char key = 'b'; key <= 'h'; ++key) {
    const std::string before(1, static_cast<char>(key - 1));
    text += std::string(1, key) + ": &" + key + " [";
    for (int i = 0; i < 9; ++i) text += (i == 0 ? "*" : ", *") + before;
    text += "]\n";
  }
  const std::string told = test::refusal_of<ConfigError>([&] { parse_yaml(text, "r.yaml"); });
  EXPECT_NE(told.find("is of more values than a robot has"), std::string::npos) << told;
}

TEST(YamlTree, ErasingTakesKeyAndValue) {
  YamlTree tree = parse_yaml("{a: 1, b: 2, c: 3}", "r.yaml");
  EXPECT_TRUE(tree.erase("b"));
  EXPECT_FALSE(tree.erase("b"));
  EXPECT_EQ(tree.text_of("c"), "3");
  EXPECT_EQ(tree.keys.size(), 2u);
}

TEST(YamlTree, MergedMapsKeepEachValuesLineAndListsAreReplaced) {
  const YamlTree base = parse_yaml("m: {a: 1, b: 2}\nl: [1, 2, 3]", "r.yaml");
  const YamlTree own = parse_yaml("\n\nm: {b: 5, c: 6}\nl: [7]", "r.yaml");
  const YamlTree both = merged(base, own);
  EXPECT_EQ(both.find("m")->text_of("a"), "1");
  EXPECT_EQ(both.find("m")->find("a")->line, 1);
  EXPECT_EQ(both.find("m")->text_of("b"), "5");
  EXPECT_EQ(both.find("m")->find("b")->line, 3);
  EXPECT_EQ(both.find("m")->keys[1].line, 3);
  EXPECT_EQ(both.find("m")->text_of("c"), "6");
  EXPECT_EQ(both.find("l")->items.size(), 1u);
}

TEST(YamlTree, AMapThatIsLikeAnotherDoesNotBeginWithTheOneBelowIt) {
  const YamlTree both = merged(parse_yaml("m: {a: 1}", "r.yaml"), parse_yaml("m: {like: n}", "r.yaml"));
  EXPECT_EQ(both.find("m")->find("a"), nullptr);
}

}  // namespace
}  // namespace sprung
