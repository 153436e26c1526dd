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

TEST(Enumerations, EachIsListedOnceWithItsNames) {
  std::set<std::string> seen;
  for (const Enumeration& one : enumerations()) {
    EXPECT_TRUE(seen.insert(one.name).second) << one.name;
    EXPECT_STREQ(one.text(-1), "unknown") << one.name;
  }
  EXPECT_STREQ(find_enumeration("LegPhase")->text(3), "thrust");
  EXPECT_STREQ(find_enumeration("ImuStatus")->text(2), "no attitude");
  EXPECT_STREQ(find_enumeration("SimControlKind")->text(7), "imu");
  EXPECT_STREQ(find_enumeration("LogEndReason")->text(1), "goes on in the next part");
}

TEST(Enumerations, OthersAreNotFound) {
  EXPECT_EQ(find_enumeration("LegPhases"), nullptr);
  EXPECT_EQ(find_enumeration(""), nullptr);
}

}  // namespace
}  // namespace sprung::fields
