#include "tools/logs/fields/type_table.h"

#include <gtest/gtest.h>

#include <string>

#include "lcmtypes/former.h"
#include "tools/logs/fields/lcm_text.h"

namespace sprung::fields {
namespace {

TEST(TypeTable, FindsByNameWithAndWithoutPackage) {
  TypeTable table;
  table.add({"package a; struct x_t { int8_t v; }", "package b; struct x_t { int16_t v; }"});
  ASSERT_NE(table.by_name("b.x_t"), nullptr);
  EXPECT_EQ(table.by_name("b.x_t")->package, "b");
  EXPECT_EQ(table.by_name("x_t")->package, "a");
  EXPECT_EQ(table.by_name("y_t"), nullptr);
  EXPECT_EQ(table.by_name("c.x_t"), nullptr);
}

TEST(TypeTable, LinksTypesOfOtherTexts) {
  TypeTable table;
  table.add({"package a; struct x_t { y_t v[2]; }", "package a; struct y_t { double w; string s; }"});
  EXPECT_EQ(table.by_name("x_t")->members[0].type, table.by_name("y_t"));
  EXPECT_EQ(table.by_name("x_t")->least_size, 2 * (8 + 5));
  table.add({"package b; struct z_t { a.x_t v; }"});
  EXPECT_EQ(table.by_name("z_t")->members[0].type, table.by_name("x_t"));
}

TEST(TypeTable, AMissingTypeIsNamed) {
  TypeTable table;
  try {
    table.add({"package a; struct x_t { lost_t v; }"});
    FAIL();
  } catch (const BadLcmText& bad) {
    EXPECT_STREQ(bad.what(), "x_t.v: no type lost_t");
  }
}

TEST(TypeTable, ARepliesFormerFingerprintIsKnown) {
  TypeTable former;
  former.add(
      {"package sprung_msgs; struct operator_reply_t { int64_t session, utime, seq, request_id, "
       "took_effect_at_seq;"
       " int8_t outcome; string from; string reason; }"});
  const std::int64_t hash = former.all().front().hash;
  EXPECT_EQ(hash, kFormerOperatorReplyHash);
  EXPECT_EQ(TypeTable::sprung().by_hash(hash), TypeTable::sprung().by_name("operator_reply_t"));
}

TEST(TypeTable, StructsOfConstantsAloneAreNoMessages) {
  TypeTable table;
  table.add(
      {"struct a_t { const int8_t ONE = 1; } struct b_t { } struct c_t { const int8_t TWO = 2; double v; }"});
  ASSERT_EQ(table.constants().size(), 1u);
  EXPECT_EQ(table.constants()[0].name, "a_t");
  EXPECT_EQ(table.by_name("a_t"), nullptr);
  EXPECT_EQ(table.all().size(), 2u);
}

TEST(TypeTable, TypesThatConsistOfEachOtherTwiceAreRefusedInsteadOfWalkedThroughForEver) {
  std::string chain = "struct t0_t { double v; } ";
  for (int i = 1; i < 40; ++i) {
    const std::string below = "t" + std::to_string(i - 1) + "_t";
    chain += "struct t" + std::to_string(i) + "_t { " + below + " a, b; } ";
  }
  for (const std::string& text : {std::string("struct b_t { b_t a, b; }"), chain}) {
    TypeTable table;
    EXPECT_THROW(table.add({text}), BadLcmText) << text.substr(0, 30);
  }
}

TEST(TypeTable, TheFirstOfTwoWithOneNameStays) {
  TypeTable table;
  table.add({"struct x_t { double v; }"});
  table.add({"struct x_t { int8_t v; }"});
  EXPECT_EQ(table.all().size(), 1u);
  EXPECT_EQ(table.by_name("x_t")->members[0].wire, Wire::kDouble);
}

TEST(TypeTable, FingerprintsDifferWithNamesTypesAndSizesButNotWithTheTypesOwnName) {
  TypeTable table;
  table.add(
      {"struct a_t { double v; } struct b_t { double v; } struct c_t { double w; } struct d_t { float v; }"
       "struct e_t { double v[1]; }"});
  EXPECT_EQ(table.by_name("a_t")->hash, table.by_name("b_t")->hash);
  for (const char* other : {"c_t", "d_t", "e_t"})
    EXPECT_NE(table.by_name("a_t")->hash, table.by_name(other)->hash);
}

}  // namespace
}  // namespace sprung::fields
