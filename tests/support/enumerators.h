#pragma once
/// Whether an enumeration's table has all of its values. The compiler knows them: a function template's own
/// text says "kTorque" for a value that has an enumerator, and "(sprung::DriveMode)99" for one that has none.
#include <gtest/gtest.h>

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "signals/enumeration.h"

namespace sprung::test {

template <auto Value>
constexpr bool is_enumerator() {
  constexpr std::string_view kText = __PRETTY_FUNCTION__;
  constexpr std::string_view kMark = "Value = ";
  return kText[kText.find(kMark) + kMark.size()] != '(';
}

template <class E, std::size_t... Numbers>
void expect_all_have_names(std::index_sequence<Numbers...>) {
  const auto same = [](std::size_t number, bool exists) {
    EXPECT_EQ(is_known<E>(static_cast<std::int64_t>(number)), exists) << "value " << number;
  };
  (same(Numbers, is_enumerator<static_cast<E>(Numbers)>()), ...);
}

/// Every enumerator from 0 to 127 has a row, no two rows the same name, and values count from 0 without
/// holes.
template <class E>
void expect_own_names() {
  SCOPED_TRACE(std::string("enumeration that begins with ") + kWords<E>[0].name);
  expect_all_have_names<E>(std::make_index_sequence<128>());
  EXPECT_TRUE(is_dense<E>());
  std::set<std::string> names;
  for (const Word<E>& word : kWords<E>) {
    EXPECT_TRUE(names.insert(word.name).second) << word.name << " twice";
    EXPECT_STRNE(word.name, "");
    EXPECT_STREQ(name(word.value), word.name);
    EXPECT_EQ(value_named<E>(word.name), word.value);
  }
}

}  // namespace sprung::test
