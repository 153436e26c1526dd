#include "tools/logs/log/proto_schema.h"

#include <algorithm>
#include <vector>

#include "tools/logs/fields/units.h"
#include "tools/logs/log/proto_types.h"

namespace sprung::log {

namespace {

using Types = std::vector<const fields::StructType*>;

// Field numbers of google/protobuf/descriptor.proto.
constexpr std::size_t kSetFile = 1;
namespace file {
constexpr std::size_t kName = 1, kPackage = 2, kDependency = 3, kMessage = 4, kSourceInfo = 9, kSyntax = 12;
}
namespace message {
constexpr std::size_t kName = 1, kField = 2;
}
namespace field {
constexpr std::size_t kName = 1, kNumber = 3, kLabel = 4, kType = 5, kTypeName = 6, kOptions = 8,
                      kJsonName = 10;
constexpr std::uint64_t kOptional = 1, kRepeated = 3;
constexpr std::size_t kOptionPacked = 2;
}  // namespace field
namespace source_info {
constexpr std::size_t kLocation = 1, kPath = 1, kSpan = 2, kTrailingComment = 4;
}

/// "Nm; what the link feels": unit and the definition's comment; "" where there is neither.
std::string member_text(const fields::Member& member) {
  const std::string unit = fields::unit_of(member.name);
  return unit.empty() || member.comment.empty() ? unit + member.comment : unit + "; " + member.comment;
}

std::string file_name(const fields::StructType& type) {
  std::string name = proto_name(type);
  std::replace(name.begin(), name.end(), '.', '/');
  return name + ".proto";
}

std::string field_of(const fields::Member& member, std::size_t number) {
  const ProtoField what = proto_field(member);
  std::string out;
  append_delimited(field::kName, member.name, out);
  append_number(field::kNumber, number, out);
  append_number(field::kLabel, what.repeated ? field::kRepeated : field::kOptional, out);
  append_number(field::kType, static_cast<std::uint64_t>(what.type), out);
  if (member.type != nullptr) append_delimited(field::kTypeName, "." + proto_name(*member.type), out);
  if (what.repeated && proto_size(what.type) > 0) {
    std::string options;
    append_number(field::kOptionPacked, 1, options);
    append_delimited(field::kOptions, options, out);
  }
  append_delimited(field::kJsonName, member.name, out);
  return out;
}

/// Whose comment it is goes by numbers: the message 0 of the file, its field `index`. Each stands in a line
/// of its own.
std::string comment_of(const fields::Member& member, std::size_t index) {
  std::string path, span, out;
  for (const std::size_t step : {file::kMessage, std::size_t{0}, message::kField, index})
    append_varint(step, path);
  for (const std::size_t place : {index + 1, std::size_t{2}, std::size_t{2}}) append_varint(place, span);
  append_delimited(source_info::kPath, path, out);
  append_delimited(source_info::kSpan, span, out);
  append_delimited(source_info::kTrailingComment, " " + member_text(member) + "\n", out);
  return out;
}

std::string file_of(const fields::StructType& type) {
  std::string out, fields, comments;
  Types used;
  append_delimited(message::kName, type.name, fields);
  append_delimited(file::kName, file_name(type), out);
  if (!type.package.empty()) append_delimited(file::kPackage, type.package, out);
  for (std::size_t i = 0; i < type.members.size(); ++i) {
    const fields::Member& member = type.members[i];
    append_delimited(message::kField, field_of(member, i + 1), fields);
    if (!member_text(member).empty())
      append_delimited(source_info::kLocation, comment_of(member, i), comments);
    if (member.type == nullptr || member.type == &type) continue;
    if (std::find(used.begin(), used.end(), member.type) != used.end()) continue;
    used.push_back(member.type);
    append_delimited(file::kDependency, file_name(*member.type), out);
  }
  append_delimited(file::kMessage, fields, out);
  append_delimited(file::kSourceInfo, comments, out);
  append_delimited(file::kSyntax, "proto3", out);
  return out;
}

/// @param done also holds what is being written, so that a ring ends.
void append_files(const fields::StructType& type, Types& done, std::string& out) {
  if (std::find(done.begin(), done.end(), &type) != done.end()) return;
  done.push_back(&type);
  for (const fields::Member& member : type.members) {
    if (member.type != nullptr) append_files(*member.type, done, out);
  }
  append_delimited(kSetFile, file_of(type), out);
}

}  // namespace

std::string proto_schema(const fields::StructType& type) {
  std::string out;
  Types done;
  append_files(type, done, out);
  return out;
}

}  // namespace sprung::log
