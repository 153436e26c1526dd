#pragma once
/// Whether an enumeration's table has all of its values. The compiler knows them: a function template's own
/// text says "kTorque" for a value that has an enumerator, and "(sprung::DriveMode)99" for one that has none.
#include <gtest/gtest.h>

#include <cctype>
#include <cstddef>
#include <functional>
#include <map>
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

/// "kPreStance" becomes "k_Pre_Stance".
inline std::string with_underscores(std::string_view camel_case) {
  std::string out;
  for (const char letter : camel_case) {
    if (!out.empty() && std::isupper(static_cast<unsigned char>(letter)) != 0) out += '_';
    out += letter;
  }
  return out;
}

/// "PRE_STANCE" for LegPhase::kPreStance: the name of its constant in lcmtypes/enumerations.lcm.
template <auto Value>
std::string constant_name() {
  std::string_view text = __PRETTY_FUNCTION__;
  text.remove_prefix(text.find("Value = "));
  text = text.substr(0, text.find_first_of(";]"));
  std::string out = with_underscores(text.substr(text.rfind("::k") + 3));
  for (char& letter : out) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return out;
}

/// "leg_phase_t" for LegPhase: the name of its struct there.
template <class E>
std::string constants_type() {
  std::string_view text = __PRETTY_FUNCTION__;
  text.remove_prefix(text.find("E = "));
  text = text.substr(0, text.find_first_of(";]"));
  std::string out = with_underscores(text.substr(text.rfind("::") + 2));
  for (char& letter : out) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return out + "_t";
}

/// Constants of E as lcmtypes/enumerations.lcm should have them.
template <class E, std::size_t... Numbers>
std::map<std::string, std::string, std::less<>> constants_of(std::index_sequence<Numbers...>) {
  std::map<std::string, std::string, std::less<>> out;
  const auto add = [&out](std::size_t number, bool exists, const std::string& name) {
    if (exists) out[name] = std::to_string(number);
  };
  (add(Numbers, is_enumerator<static_cast<E>(Numbers)>(), constant_name<static_cast<E>(Numbers)>()), ...);
  return out;
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
