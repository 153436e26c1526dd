#include "signals/enumeration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/enumerators.h"

namespace sprung {
namespace {

enum class Colour : std::int8_t { kRed = 0, kGreen = 1, kBlue = 2 };

constexpr auto words_of(Colour) {
  using E = Colour;
  return words<E>({{E::kRed, "red"}, {E::kGreen, "green"}, {E::kBlue, "blue"}});
}

/// Values 1 and 4, and one that has no name.
enum class Odd : std::int8_t { kOne = 1, kFour = 4, kNameless = 5 };

constexpr auto words_of(Odd) {
  using E = Odd;
  return words<E>({{E::kOne, "one"}, {E::kFour, "four"}});
}

static_assert(name(Colour::kGreen)[0] == 'g', "names are there while compiling");

TEST(Enumeration, ValuesHaveNamesAndNamesValues) {
  EXPECT_STREQ(name(Colour::kBlue), "blue");
  EXPECT_EQ(value_named<Colour>("blue"), Colour::kBlue);
  EXPECT_THAT(names_of<Colour>(), testing::ElementsAre("red", "green", "blue"));
}

TEST(Enumeration, WhatIsNoValueIsUnknown) {
  EXPECT_STREQ(name(static_cast<Colour>(3)), "unknown");
  EXPECT_STREQ(name(static_cast<Colour>(-1)), "unknown");
  for (const char* text : {"", "Blue", "blu", "blue "}) EXPECT_EQ(value_named<Colour>(text), std::nullopt);
  EXPECT_TRUE(is_known<Colour>(0));
  EXPECT_FALSE(is_known<Colour>(3));
  EXPECT_FALSE(is_known<Colour>(-1));
  EXPECT_FALSE(is_known<Colour>(256)) << "not cut to a byte";
}

TEST(Enumeration, HolesAreSeen) {
  EXPECT_TRUE(is_dense<Colour>());
  EXPECT_FALSE(is_dense<Odd>());
  EXPECT_STREQ(name(Odd::kFour), "four");
  EXPECT_FALSE(is_known<Odd>(2));
}

TEST(Enumeration, TheCheckOfTablesSeesAnEnumeratorWithoutAName) {
  test::expect_own_names<Colour>();
  EXPECT_TRUE(test::is_enumerator<Odd::kNameless>());
  EXPECT_FALSE(test::is_enumerator<static_cast<Odd>(6)>());
  EXPECT_FALSE(is_known<Odd>(static_cast<int>(Odd::kNameless)));
}

}  // namespace
}  // namespace sprung
