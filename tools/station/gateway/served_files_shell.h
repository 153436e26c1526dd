#pragma once
/// Files that the gateway gives to operators. Reads them.
#include <string>

#include "tools/station/gateway/file_parts.h"

namespace sprung::gateway {

/// What is asked for, of the file that lies there; its error says where there is none.
FilePart read_part(const PartRequest& request, const std::string& path);

}  // namespace sprung::gateway
