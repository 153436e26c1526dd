#pragma once
/// Reads the text of .lcm files: packages, structs, constants as sizes, comments.
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "tools/logs/fields/schema.h"

namespace sprung::fields {

struct BadLcmText : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Structs in the order in which they stand. Types of other structs are not yet linked, hashes not yet
/// computed: TypeTable does.
/// @throws BadLcmText with the line.
std::vector<StructType> parse_lcm(std::string_view text);

}  // namespace sprung::fields
