#pragma once
/// One table for each enumeration: its values in words. Printing, parsing, and whether a number off the wire
/// is one of its values all come from it. The table stands beside the enumeration, in the same namespace:
///
///   constexpr auto words_of(Colour) { return words<Colour>({{Colour::kRed, "red"}, {Colour::kBlue,
///   "blue"}}); }
///
/// Then name(Colour::kRed) is "red", value_named<Colour>("blue") is kBlue, and is_known<Colour>(7) is false.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sprung {

/// A value and the word that people read and write for it.
template <class E>
struct Word {
  E value;
  const char* name;
};

template <class E, std::size_t N>
constexpr std::array<Word<E>, N> words(const Word<E> (&rows)[N]) {
  std::array<Word<E>, N> table{};
  for (std::size_t i = 0; i < N; ++i) table[i] = rows[i];
  return table;
}

/// The table of E, in the order of its values.
template <class E>
inline constexpr auto kWords = words_of(E{});

/// Static text; "unknown" for a number that is no value of E.
template <class E, class = decltype(words_of(E{}))>
constexpr const char* name(E value) noexcept {
  for (const Word<E>& word : kWords<E>) {
    if (word.value == value) return word.name;
  }
  return "unknown";
}

/// The value of exactly this name; nothing where there is none.
template <class E>
constexpr std::optional<E> value_named(std::string_view name) noexcept {
  for (const Word<E>& word : kWords<E>) {
    if (name == word.name) return word.value;
  }
  return std::nullopt;
}

/// Whether this number is a value of E.
template <class E>
constexpr bool is_known(std::int64_t number) noexcept {
  for (const Word<E>& word : kWords<E>) {
    if (static_cast<std::int64_t>(word.value) == number) return true;
  }
  return false;
}

/// Whether the values are 0, 1, 2, ... in the order of the table, so that they may index an array.
template <class E>
constexpr bool is_dense() noexcept {
  for (std::size_t i = 0; i < kWords<E>.size(); ++i) {
    if (static_cast<std::int64_t>(kWords<E>[i].value) != static_cast<std::int64_t>(i)) return false;
  }
  return true;
}

/// All names, in the order of the table: what an option may be.
template <class E>
std::vector<std::string> names_of() {
  std::vector<std::string> names;
  names.reserve(std::size(kWords<E>));
  for (const Word<E>& word : kWords<E>) names.emplace_back(word.name);
  return names;
}

}  // namespace sprung
