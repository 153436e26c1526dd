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

/// "pre_stance" of "... [with auto Value = sprung::LegPhase::kPreStance]": the last name in a function's own
/// text behind @p mark, without @p prefix, in small letters with underscores.
inline std::string last_name(std::string_view function, std::string_view mark, std::string_view prefix) {
  function.remove_prefix(function.find(mark));
  function = function.substr(0, function.find_first_of(";]"));
  function.remove_prefix(function.rfind("::") + 2 + prefix.size());
  std::string out;
  for (const char letter : function) {
    if (!out.empty() && std::isupper(static_cast<unsigned char>(letter)) != 0) out += '_';
    out += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  }
  return out;
}

/// "PRE_STANCE" for LegPhase::kPreStance: the name of its constant in lcmtypes/enumerations.lcm.
template <auto Value>
std::string constant_name() {
  std::string out = last_name(__PRETTY_FUNCTION__, "Value = ", "k");
  for (char& letter : out) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
  return out;
}

/// "leg_phase_t" for LegPhase: the name of its struct there.
template <class E>
std::string constants_type() {
  return last_name(__PRETTY_FUNCTION__, "E = ", "") + "_t";
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
