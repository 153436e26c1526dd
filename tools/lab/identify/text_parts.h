#pragma once
/// Pure.
#include <string>
#include <vector>

namespace sprung::identify {

/// "a,b" at commas; empty parts stay.
std::vector<std::string> split(const std::string& text, char separator);

}  // namespace sprung::identify
