#pragma once
/// Fields by pattern: "joints[3].gear_output_torque_Nm" one, "joints[*].gear_output_torque_Nm" or
/// "joints.gear_output_torque_Nm" of every joint, "joints[3]" all of one joint, "joints[1].*torque*" with
/// stars, "*" everything.
#include <string_view>
#include <vector>

#include "tools/logs/fields/layout.h"

namespace sprung::fields {

/// Names that stand for indices, e.g. of the robot's joints.
struct ListNames {
  std::string list;                ///< "joints"
  std::vector<std::string> names;  ///< of its elements, in order
};

/// @param names an index may then also be a name: "joints[knee]".
bool matches(std::string_view pattern, std::string_view path, const std::vector<ListNames>& names = {});

/// Fields that match any of the patterns, each once, as they are encoded; all where there is no pattern.
std::vector<const Field*> choose(const Layout& layout, const std::vector<std::string>& patterns,
                                 const std::vector<ListNames>& names = {});

/// "joints[knee].status" of "joints[1].status"; the path itself where nothing is named.
std::string with_names(std::string_view path, const std::vector<ListNames>& names);

}  // namespace sprung::fields
