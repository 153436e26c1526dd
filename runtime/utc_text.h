#pragma once
/// A time of the wall clock in words, always UTC: logs of two machines must agree.
#include <cstdint>
#include <string>

namespace sprung {

/// "2023-11-14T22:13:20.123": date and time with `between` them and so many decimals of the second (0..6).
/// "... us", the bare number, for a time so far away that its year is none.
/// @param utc_us since 1970, as utc_us() of runtime/session_clock.h gives it; may be negative.
std::string utc_text(std::int64_t utc_us, char between = 'T', int decimals = 0);

/// Whole days from one date to another, both beginning with YYYY-MM-DD; 0 where either is none.
long days_between(const std::string& from, const std::string& to);

}  // namespace sprung
