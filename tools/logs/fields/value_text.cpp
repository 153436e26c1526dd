#include "tools/logs/fields/value_text.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace sprung::fields {

namespace {

void append_hex(const MessageView& message, const Field& field, std::string& out) {
  constexpr const char* kDigits = "0123456789abcdef";
  for (const std::uint8_t byte : message.bytes(field)) {
    out += kDigits[byte >> 4U];
    out += kDigits[byte & 15U];
  }
}

template <class Number>
void append_number(Number value, std::string& out) {
  if (value != value) {  // of either sign: what divides nought by nought on this processor has one
    out += "nan";
    return;
  }
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof text, value);
  if (error == std::errc()) out.append(text, static_cast<std::size_t>(end - text));
}

std::string rounded(double value, int digits) {
  if (std::isnan(value)) return "nan";
  char text[48];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace

std::string value_text(const MessageView& message, const Field& field, int digits) {
  if (const char* const name = message.enumeration(field))
    return std::string(name) + " (" + std::to_string(message.integer(field)) + ")";
  if (field.kind == Kind::kReal) return rounded(message.number(field), digits);
  if (field.kind == Kind::kBoolean) return message.integer(field) != 0 ? "true" : "false";
  std::string out;
  append_exact(message, field, out);
  return out;
}

void append_exact(const MessageView& message, const Field& field, std::string& out) {
  switch (field.kind) {
    case Kind::kReal:
      return append_number(message.number(field), out);
    case Kind::kInteger:
    case Kind::kBoolean:
      return append_number(message.integer(field), out);
    case Kind::kText:
      out += message.text(field);
      return;
    case Kind::kBytes:
      return append_hex(message, field, out);
  }
}

}  // namespace sprung::fields
