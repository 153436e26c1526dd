#include "tools/logs/fields/enumerations.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>

#include "tools/logs/fields/type_table.h"

namespace sprung::fields {
namespace {

TEST(Enumerations, EveryOneThatAnIntegersCommentNamesIsKnown) {
  const std::regex named(R"(sprung::(\w+))");
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

TEST(Enumerations, ValuesHaveNamesOfTheirOwnFromZeroOn) {
  for (const Enumeration& one : enumerations()) {
    std::set<std::string> names;
    int value = 0;
    for (; one.text(static_cast<std::int8_t>(value)) != std::string("unknown") || value == 0; ++value)
      EXPECT_TRUE(names.insert(one.text(static_cast<std::int8_t>(value))).second) << one.name << " " << value;
    EXPECT_GE(value, 3) << one.name;
    EXPECT_STREQ(one.text(-1), "unknown") << one.name;
  }
}

TEST(Enumerations, OthersAreNotFound) {
  EXPECT_EQ(find_enumeration("LegPhases"), nullptr);
  EXPECT_EQ(find_enumeration(""), nullptr);
}

}  // namespace
}  // namespace sprung::fields
