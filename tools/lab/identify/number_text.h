#pragma once
/// Numbers as tables hold them, whatever the machine's language. Pure.
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace sprung::identify {

/// A finite number and nothing else; blanks around it and a leading plus are allowed. Nothing where it is not
/// one.
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

}  // namespace sprung::identify
