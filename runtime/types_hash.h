#pragma once
/// One number for all message types that a program was built with: programs whose numbers differ would refuse
/// each other's messages, so `sprung up` refuses them first, by name.
#include <cstdint>

namespace sprung {

std::int64_t types_hash() noexcept;

}  // namespace sprung
