#include "tools/logs/log/proto_types.h"

namespace sprung::log {

namespace {

ProtoType type_of(const fields::Member& member) noexcept {
  using fields::Wire;
  switch (member.wire) {
    case Wire::kInt8:
    case Wire::kInt16:
    case Wire::kInt32:
      return ProtoType::kSfixed32;
    case Wire::kInt64:
      return ProtoType::kSfixed64;
    case Wire::kByte:
      return member.is_text ? ProtoType::kString
                            : (member.dimensions.empty() ? ProtoType::kFixed32 : ProtoType::kBytes);
    case Wire::kFloat:
      return ProtoType::kFloat;
    case Wire::kDouble:
      return ProtoType::kDouble;
    case Wire::kBoolean:
      return ProtoType::kBool;
    case Wire::kString:
      return ProtoType::kString;
    case Wire::kStruct:
      return ProtoType::kMessage;
  }
  return ProtoType::kBytes;
}

}  // namespace

ProtoField proto_field(const fields::Member& member) noexcept {
  const std::size_t in_one_value = member.wire == fields::Wire::kByte ? 1 : 0;
  return {type_of(member), member.dimensions.size() > in_one_value};
}

std::size_t proto_size(ProtoType type) noexcept {
  switch (type) {
    case ProtoType::kDouble:
    case ProtoType::kSfixed64:
      return 8;
    case ProtoType::kFloat:
    case ProtoType::kFixed32:
    case ProtoType::kSfixed32:
      return 4;
    case ProtoType::kBool:
      return 1;
    default:
      return 0;
  }
}

ProtoWire proto_wire(ProtoType type) noexcept {
  switch (proto_size(type)) {
    case 8:
      return ProtoWire::kFixed64;
    case 4:
      return ProtoWire::kFixed32;
    case 1:
      return ProtoWire::kVarint;
    default:
      return ProtoWire::kLength;
  }
}

std::string proto_name(const fields::StructType& type) {
  return type.package.empty() ? type.name : type.package + "." + type.name;
}

}  // namespace sprung::log
