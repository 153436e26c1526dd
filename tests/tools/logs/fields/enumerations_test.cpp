#include "tools/logs/fields/enumerations.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <utility>

#include "tests/support/every_enumeration.h"
#include "tools/logs/fields/type_table.h"

namespace sprung::fields {
namespace {

/// Of a struct of constants; none where there is no such struct.
std::map<std::string, std::string, std::less<>> constants_of(const std::string& name) {
  for (const StructType& type : TypeTable::sprung().constants()) {
    if (type.name == name) return type.constants;
  }
  return {};
}

TEST(Enumerations, EveryOneThatAnIntegersCommentNamesIsKnown) {
  const std::regex named(R"(\b([a-z_]+_t)\b)");
  int seen = 0;
  for (const StructType& type : TypeTable::sprung().all()) {
    for (const Member& member : type.members) {
      std::smatch match;
      if (member.wire != Wire::kInt8 || !std::regex_search(member.comment, match, named)) continue;
      ++seen;
      ASSERT_NE(member.enumeration, nullptr)
          << type.name << "." << member.name << ": add " << match[1] << " to enumerations.cpp";
      EXPECT_EQ(match[1], member.enumeration->name);
    }
  }
  EXPECT_GT(seen, 20);
}

TEST(Enumerations, EachIsListedOnceWithItsNames) {
  std::set<std::string> seen;
  for (const Enumeration& one : enumerations()) {
    EXPECT_TRUE(seen.insert(one.name).second) << one.name;
    EXPECT_STREQ(one.text(-1), "unknown") << one.name;
  }
  EXPECT_STREQ(find_enumeration("leg_phase_t")->text(3), "thrust");
  EXPECT_STREQ(find_enumeration("imu_status_t")->text(2), "no attitude");
  EXPECT_STREQ(find_enumeration("sim_control_kind_t")->text(7), "imu");
  EXPECT_STREQ(find_enumeration("log_end_reason_t")->text(1), "goes on in the next part");
}

TEST(Enumerations, EveryEnumeratorHasItsConstantInLcm) {
  std::size_t asked = 0;
  test::of_every_enumeration([&asked](auto value) {
    using E = decltype(value);
    const std::string name = test::constants_type<E>();
    EXPECT_EQ(constants_of(name), test::constants_of<E>(std::make_index_sequence<128>())) << name;
    EXPECT_NE(find_enumeration(name), nullptr) << name;
    ++asked;
  });
  EXPECT_EQ(asked, enumerations().size()) << "one is missing in every_enumeration.h";
  EXPECT_EQ(asked, TypeTable::sprung().constants().size());
}

TEST(Enumerations, TheFirstInACommentCounts) {
  EXPECT_STREQ(enumeration_in("an int8_t: walk: gait_control_t; jump_mode_t")->name, "gait_control_t");
  EXPECT_EQ(enumeration_in("gait_control_ts, sprung_gait_control_t"), nullptr);
  EXPECT_EQ(enumeration_in(""), nullptr);
}

TEST(Enumerations, OthersAreNotFound) {
  EXPECT_EQ(find_enumeration("leg_phases_t"), nullptr);
  EXPECT_EQ(find_enumeration(""), nullptr);
}

}  // namespace
}  // namespace sprung::fields
