#pragma once
/// Message types as data: what an .lcm file says, with units and enumerations, so that tools read any message
/// without its class.
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tools/logs/fields/enumerations.h"

namespace sprung::fields {

/// How one element is encoded.
enum class Wire : std::int8_t {
  kInt8,
  kInt16,
  kInt32,
  kInt64,
  kByte,
  kFloat,
  kDouble,
  kBoolean,
  kString,
  kStruct
};

/// Bytes of one element; 0 for kString and kStruct, whose size varies.
std::size_t size_of(Wire wire) noexcept;

struct StructType;

/// One pair of brackets behind a member's name.
struct Dimension {
  std::string text;                ///< as written: a number, or the name of the member that counts
  std::int64_t fixed = 0;          ///< where count_member is -1
  std::int32_t count_member = -1;  ///< index of the counting member in the same struct
};

struct Member {
  std::string name;
  std::string type_name;  ///< as written
  Wire wire = Wire::kDouble;
  const StructType* type = nullptr;  ///< where wire is kStruct
  std::vector<Dimension> dimensions;
  std::string comment;                       ///< above it and behind it, in one line
  const Enumeration* enumeration = nullptr;  ///< of an integer whose comment names one of sprung's
  bool is_count = false;                     ///< another member's size
  bool is_text = false;                      ///< bytes that hold a zero-terminated text, as the comment says
};

struct StructType {
  std::string package;
  std::string name;  ///< without package
  std::vector<Member> members;
  std::map<std::string, std::string, std::less<>> constants;  ///< numbers as written
  std::int64_t hash = 0;       ///< LCM's fingerprint, first 8 bytes of an encoded message
  std::size_t least_size = 0;  ///< bytes that one takes at least, without the fingerprint
};

}  // namespace sprung::fields
