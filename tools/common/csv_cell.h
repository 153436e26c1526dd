#pragma once
/// Comma-separated values, as spreadsheets and pandas read them (RFC 4180).
#include <string>
#include <string_view>

namespace sprung {

/// Appends a text as a cell: in quotes, where it needs them.
inline void append_cell(std::string_view text, std::string& out) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) {
    out += text;
    return;
  }
  out += '"';
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

}  // namespace sprung
