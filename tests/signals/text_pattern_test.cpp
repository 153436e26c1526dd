#include "signals/text_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace sprung {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(TextPattern, MatchesTheWholeText) {
  const TextPattern pattern("[a-f]+");
  EXPECT_TRUE(pattern.matches("cafe"));
  EXPECT_FALSE(pattern.matches("cafes"));
  EXPECT_FALSE(pattern.matches("CAFE"));
  EXPECT_TRUE(TextPattern("[a-f]+", Letters::kAnyCase).matches("CaFe"));
}

TEST(TextPattern, GroupsAreWholeAndParts) {
  const TextPattern pattern("([0-9a-f]{4})(sub[0-9a-f]+)?");
  EXPECT_THAT(pattern.groups("1018sub1"), ElementsAre("1018sub1", "1018", "sub1"));
  EXPECT_THAT(pattern.groups("1018"), ElementsAre("1018", "1018", ""));
  EXPECT_THAT(pattern.groups("what else"), IsEmpty());
}

TEST(TextPattern, WhatIsNoExpressionIsNamed) {
  try {
    const TextPattern pattern("(a");
    FAIL() << "it was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("'(a' is no regular expression: "));
  }
}

}  // namespace
}  // namespace sprung
