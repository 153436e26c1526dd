#pragma once
/// A tree as YAML again, typed out: what an expanded robot file says, and where each value came from.
#include <string>

#include "robots/yaml_reader.h"

namespace sprung {

/// Block style, what is of texts alone in one line; parse_yaml() reads the same values back.
std::string yaml_text(const YamlTree& tree);

/// The same of a file that has been read, and behind each value "# robot.yaml:12", where it was typed; what
/// was not typed and taken by default stands there as a comment, "# power_limit: 0 W   (default)".
std::string explained_yaml_text(const YamlMap& file);

}  // namespace sprung
