#pragma once
/// A fuzz target: a function that takes any bytes, and must neither crash, hang, grow nor break what it
/// requires. With clang libFuzzer calls it (tests/fuzz/run); corpus_test.cpp replays what is known with the
/// tests' own compiler.
///
///   SPRUNG_FUZZ(drivers_canopen_eds, seeds) { ... the bytes are `input` ... }
///
/// Each target has a namespace of its name, since sources are compiled together.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/fuzz/fuzz_input.h"

namespace sprung::fuzz {

struct Target {
  const char* name;  ///< of its source without "_fuzz.cpp", and of its corpus
  void (*run)(Input input);
  std::vector<std::string> (*seeds)();  ///< good inputs, made with the product's own code: never out of date
};

/// Those that are linked in.
std::vector<Target>& targets();

struct Registered {
  explicit Registered(const Target& target) { targets().push_back(target); }
};

/// @throws std::logic_error unless it holds: a finding.
void require(bool holds, const char* what);

}  // namespace sprung::fuzz

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): a function and its entry in the list are one
#define SPRUNG_FUZZ(name, seeds)                                               \
  static void name(::sprung::fuzz::Input input);                               \
  static const ::sprung::fuzz::Registered name##_entry({#name, &name, seeds}); \
  static void name(::sprung::fuzz::Input input)
