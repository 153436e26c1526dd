#pragma once
/// Values of single keys in an EDS: types, access words, numbers with $NODEID. For eds.cpp.
#include "drivers/canopen/eds.h"

namespace sprung::canopen {

/// The section's DataType. @throws EdsError on types that are not supported.
EdsType read_type(const IniSection& section);
/// Sets access and both PDO directions from AccessType and PDOMapping.
void read_access(const IniSection& section, EdsObject& object);
/// Sets default and limits; they must fit the type, and the default the limits.
void read_values(const IniSection& section, int node, EdsObject& object);
/// A whole number, decimal, 0x hexadecimal or 0 octal; `otherwise` when the key is absent.
std::int64_t read_integer(const IniSection& section, const std::string& key, std::int64_t otherwise,
                          std::int64_t low, std::int64_t high);

}  // namespace sprung::canopen
