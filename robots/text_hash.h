#pragma once
#include <cstdint>
#include <cstdio>
#include <string>

namespace sprung {

/// FNV-1a, not negative: a name for a text, no protection against anyone.
inline std::int64_t hash_text(const std::string& text) noexcept {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return static_cast<std::int64_t>(hash >> 1);
}

/// A hash as people compare it: 16 hexadecimal digits.
inline std::string hash_digits(std::int64_t hash) {
  char text[24];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
  return text;
}

}  // namespace sprung
