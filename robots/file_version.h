#pragma once
/// Which version of sprung a robot.yaml was written for, by its key `sprung: 0.1`; a file without it is read
/// as of this version. A file that somebody keeps through an upgrade is so held against the programs.
#include <string>

#include "robots/yaml_reader.h"

namespace sprung {

/// One sentence; empty where the file can be read. A later patch of the same minor version changes no key's
/// meaning.
/// @param written_for "0.1", what the file says. @param program "0.1.0", what reads it.
std::string why_not_readable(const std::string& written_for, const std::string& program);

/// @throws ConfigError at the key's line where this build cannot read the file.
void check_file_version(const YamlMap& file);

}  // namespace sprung
