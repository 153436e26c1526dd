#include "tools/logs/fields/lcm_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::fields {
namespace {

std::string complaint_about(const std::string& text) {
  try {
    parse_lcm(text);
  } catch (const BadLcmText& bad) {
    return bad.what();
  }
  return "";
}

TEST(LcmText, ReadsMembersSizesAndPackages) {
  const auto types = parse_lcm(R"(package a.b;
    /* several
       lines */
    struct one_t { int32_t n; double x[n][3], y; c.two_t other; })");
  ASSERT_EQ(types.size(), 1u);
  EXPECT_EQ(types[0].package, "a.b");
  EXPECT_EQ(types[0].name, "one_t");
  ASSERT_EQ(types[0].members.size(), 4u);
  EXPECT_TRUE(types[0].members[0].is_count);
  ASSERT_EQ(types[0].members[1].dimensions.size(), 2u);
  EXPECT_EQ(types[0].members[1].dimensions[0].count_member, 0);
  EXPECT_EQ(types[0].members[1].dimensions[1].fixed, 3);
  EXPECT_TRUE(types[0].members[2].dimensions.empty());
  EXPECT_EQ(types[0].members[3].wire, Wire::kStruct);
  EXPECT_EQ(types[0].members[3].type_name, "c.two_t");
}

TEST(LcmText, CommentsBelongToTheMemberBelowThemOrBeforeThemOnItsLine) {
  const auto types = parse_lcm(
      "struct a_t { // of nobody\n // above\n /* and\n more */ int8_t x; // behind\n // of y\n int8_t y, "
      "z;\n\n"
      " int8_t w;\n // of nobody\n}");
  EXPECT_EQ(types[0].members[0].comment, "above and\n more behind");
  EXPECT_EQ(types[0].members[1].comment, "of y");
  EXPECT_EQ(types[0].members[2].comment, "of y");
  EXPECT_EQ(types[0].members[3].comment, "");
}

TEST(LcmText, AnEnumerationIsNamedInTheComment) {
  const auto types = parse_lcm(
      "struct a_t { // stands above: leg_phase_t, now\n int8_t x; // leg_phase_t, now\n // see leg_phase_t\n "
      "double y;\n"
      " // leg_phases_t\n int8_t z;\n }");
  ASSERT_NE(types[0].members[0].enumeration, nullptr);
  EXPECT_STREQ(types[0].members[0].enumeration->name, "leg_phase_t");
  EXPECT_EQ(types[0].members[1].enumeration, nullptr);
  EXPECT_EQ(types[0].members[2].enumeration, nullptr);
}

TEST(LcmText, ConstantsAreKeptAsTheyStand) {
  const auto types = parse_lcm(
      "struct a_t {\n // one\n const int8_t ONE = 1, TWO = 2; // both\n const int8_t NONE = -1;\n double x; "
      "}");
  EXPECT_THAT(types[0].constants, testing::ElementsAre(testing::Pair("NONE", "-1"), testing::Pair("ONE", "1"),
                                                       testing::Pair("TWO", "2")));
  EXPECT_EQ(types[0].members[0].comment, "");
}

TEST(LcmText, ConstantsMayBeSizes) {
  const auto types = parse_lcm("struct a_t { const int32_t kN = 4, kM = 5; double x[kM]; }");
  EXPECT_EQ(types[0].members[0].dimensions[0].fixed, 5);
  EXPECT_EQ(types[0].members[0].dimensions[0].text, "5");
}

TEST(LcmText, ComplaintsNameTheLine) {
  EXPECT_THAT(complaint_about("struct a_t {\n double x[n];\n}"), testing::HasSubstr("line 2"));
  EXPECT_THAT(complaint_about("struct a_t {\n double n; double x[n]; }"), testing::HasSubstr("'n'"));
  EXPECT_THAT(complaint_about("struct a_t { int32_t x"), testing::HasSubstr("too early"));
  EXPECT_THAT(complaint_about("class a_t {}"), testing::HasSubstr("'class'"));
  EXPECT_THAT(complaint_about("struct a_t { int8_t x[4y]; }"), testing::HasSubstr("'4y'"));
  EXPECT_THAT(complaint_about("/* for ever"), testing::HasSubstr("does not end"));
  EXPECT_EQ(complaint_about("// nothing"), "");
}

}  // namespace
}  // namespace sprung::fields
