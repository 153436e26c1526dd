#pragma once
/// What a member of an LCM type is in protocol buffers. Pure.
#include <cstddef>
#include <cstdint>
#include <string>

#include "tools/logs/fields/schema.h"
#include "tools/logs/log/proto_bytes.h"

namespace sprung::log {

/// Numbered as FieldDescriptorProto.Type is (google/protobuf/descriptor.proto). Integers are of fixed width:
/// quick to write and to read, and what zstd finds to repeat itself.
enum class ProtoType : std::uint8_t {
  kDouble = 1,
  kFloat = 2,
  kFixed32 = 7,  ///< byte
  kBool = 8,
  kString = 9,
  kMessage = 11,
  kBytes = 12,
  kSfixed32 = 15,  ///< int8_t, int16_t, int32_t
  kSfixed64 = 16,  ///< int64_t
};

struct ProtoField {
  ProtoType type = ProtoType::kDouble;
  bool repeated = false;  ///< lists of lists are one list, the last index running first; a list of bytes is
                          ///< one value
};
ProtoField proto_field(const fields::Member& member) noexcept;

/// Bytes of one value; 0 where it has a length of its own.
std::size_t proto_size(ProtoType type) noexcept;
ProtoWire proto_wire(ProtoType type) noexcept;

/// "sprung_msgs.joint_state_t".
std::string proto_name(const fields::StructType& type);

}  // namespace sprung::log
