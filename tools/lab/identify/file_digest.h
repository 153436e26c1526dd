#pragma once
/// Which file exactly: its SHA-256. Reads files.
#include <string>

namespace sprung::identify {

/// The first 16 hexadecimal digits. @throws std::runtime_error when the file cannot be read.
std::string short_sha256(const std::string& path);

}  // namespace sprung::identify
