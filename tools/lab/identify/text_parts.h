#pragma once
/// Words of an operator and cells of a table: numbers, parts, spans of time. Pure.
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "estimator/identification/raw_series.h"

namespace sprung::identify {

/// Whatever the machine's language: a finite number and nothing else; blanks around it and a leading plus are
/// allowed. Nothing where it is not one.
inline std::optional<double> parse_number(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    return std::nullopt;
  return value;
}

/// "a,b" at commas; empty parts stay.
std::vector<std::string> split(const std::string& text, char separator);

/// "8:60" or "0:0.25,0.5:0.75". @param option for messages, "--window". @throws std::invalid_argument with an
/// example.
std::vector<identification::TimeSpan> parse_spans(const std::string& text, const char* option);

}  // namespace sprung::identify
