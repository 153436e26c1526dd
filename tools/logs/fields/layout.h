#pragma once
/// Where each field of one shape of a message lies. Messages of a type whose counts are the same share a
/// shape; strings may be of any length: they cut the bytes into segments, and a field is found by its
/// segment's begin and its offset in it.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "signals/enumeration.h"
#include "tools/logs/fields/schema.h"

namespace sprung::fields {

/// Why bytes are not a message of a known type.
enum class Fault : std::int8_t {
  kNone = 0,
  kTooShort,     ///< ends before its last field, or has no fingerprint at all
  kUnknownType,  ///< nobody knows its fingerprint: another type, or another version of one
  kBadCount,     ///< negative, more than the bytes can hold, or nested too deep
  kBadText,      ///< a string's length does not fit, or it does not end in zero
  kTrailing,     ///< bytes are left over
};
constexpr auto words_of(Fault) {
  using E = Fault;
  return words<E>({{E::kNone, "none"},
                   {E::kTooShort, "too short"},
                   {E::kUnknownType, "unknown type"},
                   {E::kBadCount, "impossible count"},
                   {E::kBadText, "broken text"},
                   {E::kTrailing, "trailing bytes"}});
}

enum class Kind : std::int8_t { kBoolean, kInteger, kReal, kText, kBytes };

/// One flat field: a number, a truth, a text, or bytes (a list of bytes is one field).
struct Field {
  std::string path;  ///< "joints[3].estimated_position_rad"
  std::string unit;  ///< "rad"; "" = none or not known
  Kind kind = Kind::kReal;
  Wire wire = Wire::kDouble;
  std::uint32_t segment = 0;
  std::uint32_t offset = 0;  ///< in the segment; of a string: of its length, right behind the segment
  std::uint32_t size = 0;    ///< bytes; 0 of a string
  const Member* member = nullptr;
  const char* (*text)(std::int8_t value) noexcept = nullptr;  ///< names of an enumeration's values
};

/// A count as this shape has it.
struct CountHere {
  std::uint32_t segment = 0;
  std::uint32_t offset = 0;
  Wire wire = Wire::kInt32;
  std::int64_t value = 0;
};

struct Layout {
  static constexpr int kNone = -1;

  const StructType* type = nullptr;
  std::vector<Field> fields;                 ///< as they are encoded
  std::vector<CountHere> counts;             ///< as they are encoded
  std::vector<std::uint32_t> segment_sizes;  ///< one more than there are strings
  int session = kNone;  ///< indices of the stamp in fields; kNone where the type has none
  int utime = kNone;
  int seq = kNone;

  /// Index of the field of that path, or kNone.
  int find(std::string_view path) const noexcept;
};

/// The layout of the message in `data`, which must hold it exactly, fingerprint first. Reads no byte beyond
/// `size`.
/// @return nullptr and a fault unless it is a message of `type`.
std::shared_ptr<const Layout> build_layout(const StructType& type, const std::uint8_t* data, std::size_t size,
                                           Fault& fault);

/// Big-endian integers of any width, sign extended (kByte and kBoolean: 0..255); the caller has checked that
/// the bytes are there.
std::int64_t read_integer(Wire wire, const std::uint8_t* at) noexcept;

}  // namespace sprung::fields
