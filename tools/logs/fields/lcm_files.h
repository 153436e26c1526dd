#pragma once
/// The texts of lcmtypes/*.lcm, built in; the list is made by tools/logs/fields/CMakeLists.txt from what
/// lcm-gen is given.
#include <string_view>
#include <vector>

namespace sprung::fields {

std::vector<std::string_view> lcm_files();

}  // namespace sprung::fields
