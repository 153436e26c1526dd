#include "tools/logs/fields/type_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <tuple>

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

/// As Debian's lcm-gen made them of lcmtypes/ at fe05734.
constexpr std::int64_t kFormerReplyHash = 0x3e25ef2266fe2692;
constexpr std::int64_t kFormerBusStateHash = 0x78035c76d2a3c128;
/// The same at 148009d1.
constexpr auto kFormerMotionHash = static_cast<std::int64_t>(0xc1c2d8b625cebf5bU);
constexpr auto kFormerTruthHash = static_cast<std::int64_t>(0x97c4e53311c98d99U);
/// The same at b926dedc.
constexpr auto kFormerBodyHash = static_cast<std::int64_t>(0xc687c3ca59f4461cU);

TEST(TypeTable, TypesOfLogsOfBeforeAreFoundByHashAndKeepTheirFields) {
  for (const auto& [hash, name, field] : {std::tuple{kFormerReplyHash, "operator_reply_t", "from"},
                                          std::tuple{kFormerBusStateHash, "bus_state_t", "recovering"},
                                          std::tuple{kFormerMotionHash, "motion_state_t", "gait_phase"},
                                          std::tuple{kFormerTruthHash, "sim_truth_t", "com_in_world_m"},
                                          std::tuple{kFormerBodyHash, "body_state_t", "slips"}}) {
    const StructType* const type = TypeTable::sprung().by_hash(hash);
    ASSERT_NE(type, nullptr) << name;
    EXPECT_EQ(type->name, name);
    EXPECT_NE(type, TypeTable::sprung().by_name(name)) << "a name is that of today";
    const auto is_it = [&](const Member& member) { return member.name == field; };
    EXPECT_TRUE(std::any_of(type->members.begin(), type->members.end(), is_it)) << name << "." << field;
  }
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
