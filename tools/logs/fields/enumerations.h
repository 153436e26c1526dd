#pragma once
/// Names of sprung's enumerations, found by the name that a message definition's comment gives
/// ("sprung::LegPhase").
#include <cstdint>
#include <string_view>
#include <vector>

namespace sprung::fields {

struct Enumeration {
  const char* name;                                 ///< "LegPhase"
  const char* (*text)(std::int8_t value) noexcept;  ///< "thrust"; "unknown" where it has no such value
};

/// nullptr where sprung has none of that name. @param name without "sprung::".
const Enumeration* find_enumeration(std::string_view name) noexcept;

const std::vector<Enumeration>& enumerations();

}  // namespace sprung::fields
