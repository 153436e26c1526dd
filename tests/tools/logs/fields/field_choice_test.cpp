#include "tools/logs/fields/field_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::fields {
namespace {

const std::vector<ListNames> kNames{{"joints", {"hip", "knee"}}, {"nodes", {"left.knee"}}};

TEST(FieldChoice, OneFieldByItsPath) {
  EXPECT_TRUE(matches("joints[3].status", "joints[3].status"));
  EXPECT_FALSE(matches("joints[3].status", "joints[13].status"));
  EXPECT_FALSE(matches("joints[3].status", "joints[3].status_text"));
  EXPECT_FALSE(matches("joints[3].status.more", "joints[3].status"));
}

TEST(FieldChoice, AllElementsByStarOrWithoutBrackets) {
  for (const char* pattern : {"joints[*].status", "joints.status", "*.status", "j*s.*"})
    EXPECT_TRUE(matches(pattern, "joints[12].status")) << pattern;
  EXPECT_FALSE(matches("joint.status", "joints[12].status"));
}

TEST(FieldChoice, APartNamesAllInIt) {
  EXPECT_TRUE(matches("legs[1]", "legs[1].foot_force_N[2]"));
  EXPECT_TRUE(matches("legs[1].foot_force_N", "legs[1].foot_force_N[2]"));
  EXPECT_FALSE(matches("legs[0]", "legs[1].foot_force_N[2]"));
  EXPECT_TRUE(matches("*", "seq"));
  EXPECT_TRUE(matches("", "seq"));
}

TEST(FieldChoice, StarsInNames) {
  EXPECT_TRUE(matches("joints[0].*torque*", "joints[0].gear_output_torque_Nm"));
  EXPECT_FALSE(matches("joints[0].*torque", "joints[0].gear_output_torque_Nm"));
}

TEST(FieldChoice, SeveralIndices) {
  EXPECT_TRUE(matches("x[1][2]", "x[1][2]"));
  EXPECT_TRUE(matches("x[*][2]", "x[7][2]"));
  EXPECT_FALSE(matches("x[1][3]", "x[1][2]"));
  EXPECT_FALSE(matches("x[1][2]", "x[1]"));
}

TEST(FieldChoice, ElementsByName) {
  EXPECT_TRUE(matches("joints[knee].status", "joints[1].status", kNames));
  EXPECT_TRUE(matches("joints[k*].status", "joints[1].status", kNames));
  EXPECT_TRUE(matches("joints[1].status", "joints[1].status", kNames));
  EXPECT_FALSE(matches("joints[knee].status", "joints[0].status", kNames));
  EXPECT_FALSE(matches("legs[knee].phase", "legs[1].phase", kNames));
  EXPECT_TRUE(matches("nodes[left.knee].bus", "nodes[0].bus", kNames));
}

TEST(FieldChoice, BrokenBracketsMatchNothing) {
  EXPECT_FALSE(matches("joints[3.status", "joints[3].status"));
  EXPECT_FALSE(matches("joints[].status", "joints[3].status"));
}

TEST(FieldChoice, PathsWithNames) {
  EXPECT_EQ(with_names("joints[1].status", kNames), "joints[knee].status");
  EXPECT_EQ(with_names("joints[7].status", kNames), "joints[7].status");
  EXPECT_EQ(with_names("x[1][2].y", kNames), "x[1][2].y");
}

TEST(FieldChoice, ChoosesEachOnceInTheOrderOfTheMessage) {
  Layout layout;
  for (const char* path : {"seq", "a[0].x", "a[0].y", "a[1].x", "a[1].y"}) {
    layout.fields.emplace_back();
    layout.fields.back().path = path;
  }
  std::vector<std::string> found;
  for (const Field* field : choose(layout, {"a.y", "a[1]"})) found.push_back(field->path);
  EXPECT_THAT(found, testing::ElementsAre("a[0].y", "a[1].x", "a[1].y"));
  EXPECT_EQ(choose(layout, {}).size(), 5u);
  EXPECT_TRUE(choose(layout, {"b"}).empty());
}

}  // namespace
}  // namespace sprung::fields
