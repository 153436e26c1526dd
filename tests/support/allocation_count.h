#pragma once
/// Counts heap allocations of this test program, by new and by malloc and its kin (with the address sanitizer
/// by new only); link allocation_count.cpp into it.
#include <cstdint>

namespace sprung::test {

std::int64_t allocation_count() noexcept;

}  // namespace sprung::test
