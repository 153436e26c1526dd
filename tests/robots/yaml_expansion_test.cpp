#include "robots/yaml_expansion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/config_error.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// In one line, keys and values in order: "{a: 1, b: [x, y]}".
std::string flow(const YamlTree& tree) {
  if (tree.is_text()) return tree.text;
  std::string out;
  for (std::size_t i = 0; i < tree.items.size(); ++i)
    out += (i == 0 ? "" : ", ") + (tree.is_map() ? tree.keys[i].name + ": " : "") + flow(tree.items[i]);
  return tree.is_map() ? "{" + out + "}" : "[" + out + "]";
}

YamlTree expanded_tree(const std::string& text) {
  YamlTree tree = parse_yaml(text, "r.yaml");
  expand(tree, "r.yaml");
  return tree;
}

std::string expanded(const std::string& text) { return flow(expanded_tree(text)); }

std::string expansion_complaint(const std::string& text) {
  try {
    return expanded(text);
  } catch (const ConfigError& error) {
    return error.what();
  }
}

TEST(Expansion, LeavesAFileWithoutItsWordsAsItIs) {
  const std::string text = "{a: 1 m, b: [{name: x, c: [1, 2]}, {name: y}], d: {e: {f: g}}}";
  EXPECT_EQ(expanded(text), text);
}

TEST(Expansion, AllGivesEveryEntryOfAListWhatItDoesNotSay) {
  EXPECT_EQ(
      expanded("l:\n  - all: {a: 1 m, m: {x: 1, y: 2}}\n  - {name: p}\n  - {name: q, a: 2 m, m: {y: 3}}"),
      "{l: [{name: p, a: 1 m, m: {x: 1, y: 2}}, {name: q, a: 2 m, m: {x: 1, y: 3}}]}");
}

TEST(Expansion, AllGivesEveryEntryOfAMapOfMapsWhatItDoesNotSay) {
  EXPECT_EQ(expanded("g: {all: {a: 1}, p: {b: 2}, q: {a: 3}}"), "{g: {p: {a: 1, b: 2}, q: {a: 3}}}");
}

TEST(Expansion, LikeBeginsWithAnotherEntryOfTheSameList) {
  EXPECT_EQ(
      expanded("l: [{name: p, a: 1, m: {x: 1}}, {name: q, like: p, m: {y: 2}}, {name: r, like: q, a: 3}]"),
      "{l: [{name: p, a: 1, m: {x: 1}}, {name: q, a: 1, m: {x: 1, y: 2}}, "
      "{name: r, a: 3, m: {x: 1, y: 2}}]}");
}

TEST(Expansion, LikeMayNameWhatComesLaterAndStandAtTheTop) {
  EXPECT_EQ(expanded("a: {like: b, y: 3}\nb: {x: 1, y: 2}"), "{a: {x: 1, y: 3}, b: {x: 1, y: 2}}");
}

TEST(Expansion, LikeInsideWhatIsLikeAnotherFollowsItsOwnNeighbours) {
  EXPECT_EQ(expanded("p: {s: {k: 1}, w: {like: s, v: 9}}\nq: {like: p, s: {k: 2}, w: {like: s}}"),
            "{p: {s: {k: 1}, w: {k: 1, v: 9}}, q: {s: {k: 2}, w: {k: 2}}}")
      << "q's w is like q's s, and takes nothing from p's w";
  EXPECT_EQ(expanded("p: {s: {k: 1}, w: {like: s, v: 9}}\nq: {like: p, s: {k: 2}}"),
            "{p: {s: {k: 1}, w: {k: 1, v: 9}}, q: {s: {k: 2}, w: {k: 1, v: 9}}}")
      << "what is not typed is what it is in p";
}

TEST(Expansion, ValuesKeepTheLineWhereTheyWereTyped) {
  const YamlTree tree = expanded_tree(
      "l:\n  - all: {a: 1}\n  - {name: p, b: 2}\n  - {name: q, like: p, c: 3}\n");
  const YamlTree& q = tree.find("l")->items[1];
  EXPECT_EQ(q.find("a")->line, 2);
  EXPECT_EQ(q.find("b")->line, 3);
  EXPECT_EQ(q.find("c")->line, 4);
  EXPECT_EQ(q.line, 4);
  EXPECT_EQ(q.made, "like p");
}

constexpr const char* kLegs =
    "mirror: {leg: fl, left_right: fr, front_hind: hl, both: hr}\n"
    "legs:\n"
    "  - {name: fl, side: left, hip_in_trunk: {x: 0.3 m, y: 0.1 m, z: 0 m}, joints: [fl_hip, fl_knee]}\n";

TEST(Expansion, OneLegStandsForItsMirrorImagesInOrder) {
  EXPECT_EQ(
      expanded(kLegs),
      "{legs: [{name: fl, side: left, hip_in_trunk: {x: 0.3 m, y: 0.1 m, z: 0 m}, joints: [fl_hip, "
      "fl_knee]}, "
      "{name: fr, side: right, hip_in_trunk: {x: 0.3 m, y: -0.1 m, z: 0 m}, joints: [fr_hip, fr_knee]}, "
      "{name: hl, side: left, hip_in_trunk: {x: -0.3 m, y: 0.1 m, z: 0 m}, joints: [hl_hip, hl_knee]}, "
      "{name: hr, side: right, hip_in_trunk: {x: -0.3 m, y: -0.1 m, z: 0 m}, joints: [hr_hip, hr_knee]}]}");
}

TEST(Expansion, ImagesComeLegByLegAndOthersStayWhereTheyAre) {
  EXPECT_EQ(
      expanded(
          "mirror: {leg: l, left_right: r}\n"
          "b: [{name: base}, {name: l_hip, m: 1}, {name: l_knee, m: 2}, {name: r_knee, m: 3}, {name: tail}]"),
      "{b: [{name: base}, {name: l_hip, m: 1}, {name: l_knee, m: 2}, {name: r_hip, m: 1}, "
      "{name: r_knee, m: 3}, {name: tail}]}");
}

TEST(Expansion, AnImageMaySayForItselfWhatIsDifferent) {
  const YamlTree tree = expanded_tree(
      "mirror: {leg: l, left_right: r}\n"
      "j:\n  - all: {m: 1 kg}\n  - {name: l_hip, x: {p: 1, q: 2}}\n  - {name: r_hip, x: {q: 3}}\n");
  EXPECT_EQ(flow(tree),
            "{j: [{name: l_hip, m: 1 kg, x: {p: 1, q: 2}}, {name: r_hip, m: 1 kg, x: {p: 1, q: 3}}]}");
  const YamlTree& image = tree.find("j")->items[1];
  EXPECT_EQ(image.made, "mirror image of l_hip");
  EXPECT_EQ(image.find("x")->find("p")->line, 4);
  EXPECT_EQ(image.find("x")->find("q")->line, 5);
}

TEST(Expansion, AnImageThatIsLikeAnotherIsNoImage) {
  EXPECT_EQ(expanded("mirror: {leg: l, left_right: r}\n"
                     "j: [{name: l_hip, d: 1}, {name: l_knee, d: 2}, {name: r_hip, like: l_knee}]"),
            "{j: [{name: l_hip, d: 1}, {name: l_knee, d: 2}, {name: r_hip, d: 2}, {name: r_knee, d: 2}]}");
}

TEST(Expansion, TwoLegsMayBeTyped) {
  EXPECT_EQ(expanded("mirror: [{leg: fl, left_right: fr}, {leg: hl, left_right: hr}]\n"
                     "j: [{name: fl_hip, d: 1}, {name: hl_hip, d: 2}]"),
            "{j: [{name: fl_hip, d: 1}, {name: fr_hip, d: 1}, {name: hl_hip, d: 2}, {name: hr_hip, d: 2}]}");
}

TEST(Expansion, WhatWasIdentifiedOnOneJointIsOfNoOther) {
  const std::string
      own = "friction: {c: 5}, uncertainty: {f: 1}, identified: {log: l}, torsion: {k: 1}, a: 1";
  EXPECT_EQ(
      expanded("mirror: {leg: l, left_right: r}\nj: [{name: l_hip, " + own + "}, {name: x, like: l_hip}]"),
      "{j: [{name: l_hip, " + own + "}, {name: r_hip, a: 1}, {name: x, a: 1}]}");
  EXPECT_EQ(expanded("j:\n  - all: {friction: {m: s}}\n  - {name: p, " + own +
                     "}\n  - {name: q, like: p, friction: {c: 6}, identified: {log: q}}"),
            "{j: [{name: p, friction: {m: s, c: 5}, uncertainty: {f: 1}, identified: {log: l}, torsion: {k: "
            "1}, a: 1}, "
            "{name: q, a: 1, friction: {m: s, c: 6}, identified: {log: q}}]}")
      << "what all have in common stays";
}

TEST(Expansion, FrictionThatNobodyIdentifiedGoesOver) {
  EXPECT_EQ(expanded("mirror: {leg: l, left_right: r}\nj: [{name: l_hip, friction: {c: 5}}]"),
            "{j: [{name: l_hip, friction: {c: 5}}, {name: r_hip, friction: {c: 5}}]}");
}

TEST(Expansion, ABlankForTheNameIsFilledInWithEachEntrysOwn) {
  EXPECT_EQ(expanded("l:\n  - all: {c: \"see {name}.lcm, {name}\"}\n  - {name: p}\n  - {actuator: q, d: 1}"),
            "{l: [{name: p, c: see p.lcm, p}, {actuator: q, c: see q.lcm, q, d: 1}]}");
}

TEST(Expansion, MistakesAreNamedWithTheirLine) {
  EXPECT_THAT(expansion_complaint("l:\n  - {name: fl_hip}\n  - {name: q, like: fl_hpi}"),
              AllOf(HasSubstr("r.yaml:3: key 'like': there is no 'fl_hpi' beside it"),
                    HasSubstr("did you mean 'fl_hip'?"), HasSubstr("; there are: fl_hip, q")));
  EXPECT_THAT(expansion_complaint("a: {like: b}\nb: {like: a}"),
              AllOf(HasSubstr("r.yaml:"), HasSubstr("is like itself")));
  EXPECT_THAT(expansion_complaint("a: {like: a}"), HasSubstr("is like itself"));
  EXPECT_THAT(expansion_complaint("l:\n  - {name: p}\n  - all: {a: 1}"),
              AllOf(HasSubstr("r.yaml:3"), HasSubstr("first")));
  EXPECT_THAT(expansion_complaint("l:\n  - all: 3\n  - {name: p}"),
              AllOf(HasSubstr("r.yaml:2"), HasSubstr("a map of keys")));
  EXPECT_THAT(expansion_complaint("g:\n  all: {a: 1}\n  p: 3"),
              AllOf(HasSubstr("r.yaml:2"), HasSubstr("'p'")));
  EXPECT_THAT(expansion_complaint("l: [{name: p, flips: left_right}]"),
              AllOf(HasSubstr("r.yaml:1"), HasSubstr("no `mirror:`")));
  EXPECT_THAT(
      expansion_complaint(
          "mirror: {leg: l, left_right: r}\nj:\n  - {name: r_hip}\n  - {name: l_hip}\n  - {name: r_hip}"),
      AllOf(HasSubstr("r.yaml:5"), HasSubstr("the name 'r_hip' stands twice")));
  EXPECT_THAT(expansion_complaint("a: 1\nmirror: {leg: fl, left_right: fr}\nl: [{name: hl_hip}]"),
              AllOf(HasSubstr("r.yaml:2"), HasSubstr("no entry of any list is called fl or fl_...")));
}

/// Each level gives two entries all of the next one: 2^30 of them in 800 bytes.
TEST(Expansion, EntriesThatDoubleEachOtherAreRefused) {
  std::string text = "{a: 1}";
  for (int level = 0; level < 30; ++level) text = "{all: {m: " + text + "}, p: {}, q: {}}";
  EXPECT_THAT(expansion_complaint("top: " + text), HasSubstr("more values than a robot"));
}

}  // namespace
}  // namespace sprung
