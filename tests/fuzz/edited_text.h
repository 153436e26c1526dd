#pragma once
/// A shipped file with some lines changed: what people do to it, and far more of the loader is reached than
/// by changing bytes of a file of 20 kB.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_input.h"
#include "tests/support/paths.h"

namespace sprung::fuzz {

enum class Edit : std::uint8_t { kValue, kReplace, kInsert, kErase, kMove };

inline std::string text_of(const std::string& file) {
  std::ifstream in(test::source_dir() + "/" + file);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// One edit: what, which line, and a text. kValue changes what stands behind the line's first ':' or '=' from
/// the `at`-th word on.
inline void edit(std::vector<std::string>& lines, Input& input) {
  const auto what = static_cast<Edit>(input.byte() % 5);
  const std::size_t line = input.number<std::uint16_t>() % lines.size();
  const std::size_t at = input.byte();
  const std::string text(input.text(std::min<std::size_t>(input.byte(), 64)));
  const auto place = lines.begin() + static_cast<std::ptrdiff_t>(line);
  if (what == Edit::kReplace) *place = text;
  if (what == Edit::kInsert) lines.insert(place, text);
  if (what == Edit::kErase && lines.size() > 1) lines.erase(place);
  if (what == Edit::kMove) std::swap(lines[line], lines[(line + at) % lines.size()]);
  if (what != Edit::kValue) return;
  std::size_t begin = place->find_first_of(":=");
  for (std::size_t i = 0; i < at % 8 && begin != std::string::npos; ++i)
    begin = place->find_first_of(" \",[:{=", begin + 1);
  if (begin == std::string::npos) return;
  const std::size_t end = place->find_first_of(" \",]}/>", begin + 2);
  place->replace(begin + 1, (end == std::string::npos ? place->size() : end) - begin - 1, text);
}

inline std::string edited(const std::string& text, Input& input) {
  std::vector<std::string> lines = lines_of(text);
  for (int i = 0; i < 16 && !input.done(); ++i) edit(lines, input);
  std::string out;
  for (const std::string& line : lines) out += line + "\n";
  return out;
}

inline std::string edit_bytes(Edit what, std::size_t line, int at, const std::string& text) {
  return Output()
      .byte(static_cast<int>(what))
      .number(static_cast<std::uint16_t>(line))
      .byte(at)
      .byte(static_cast<int>(text.size()))
      .text(text)
      .bytes();
}

/// For a file of so many lines: nothing, and each kind of edit at lines all over it. @param head of each
/// seed.
inline std::vector<std::string> edit_seeds(const std::string& head, std::size_t lines) {
  std::vector<std::string> seeds{head};
  const std::vector<std::string> values = {" nan",    " -1 m",   " 1e300 kg", " 0",
                                           " [1, 2]", " {a: 1}", "",          " 99999999999999999999"};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t line = (2 * i + 1) * lines / (2 * values.size());
    seeds.push_back(head + edit_bytes(Edit::kValue, line, static_cast<int>(i) % 3, values[i]));
    seeds.push_back(head + edit_bytes(Edit::kErase, line + 1, 0, "") + edit_bytes(Edit::kMove, line, 3, ""));
  }
  seeds.push_back(head + edit_bytes(Edit::kInsert, lines / 2, 0, "  like: hip") +
                  edit_bytes(Edit::kReplace, 3, 0, "- a"));
  return seeds;
}

}  // namespace sprung::fuzz
