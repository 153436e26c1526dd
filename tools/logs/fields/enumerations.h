#pragma once
/// Names of sprung's enumerations, found by the name that a message definition's comment gives
/// ("leg_phase_t", lcmtypes/enumerations.lcm).
#include <cstdint>
#include <string_view>
#include <vector>

namespace sprung::fields {

struct Enumeration {
  const char* name;                                 ///< "leg_phase_t"
  const char* (*text)(std::int8_t value) noexcept;  ///< "thrust"; "unknown" where it has no such value
};

/// nullptr where sprung has none of that name.
const Enumeration* find_enumeration(std::string_view name) noexcept;

/// The first that a comment names; nullptr where it names none.
const Enumeration* enumeration_in(std::string_view comment) noexcept;

const std::vector<Enumeration>& enumerations();

}  // namespace sprung::fields
