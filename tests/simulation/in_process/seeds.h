#pragma once
/// How many seeds a test that is run on each of them takes: `usual`, or what SPRUNG_SEEDS asks for. Figures
/// of docs/measured.md name the number that they were made with.
#include <cstdint>
#include <cstdlib>

namespace sprung::test {

inline std::uint64_t seeds(std::uint64_t usual = 2) {
  const char* asked = std::getenv("SPRUNG_SEEDS");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : usual;
}

}  // namespace sprung::test
