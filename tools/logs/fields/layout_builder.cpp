#include <array>
#include <limits>

#include "tools/logs/fields/layout.h"
#include "tools/logs/fields/units.h"

namespace sprung::fields {

namespace {

constexpr std::size_t kBody = 8;
constexpr int kDeepest = 32;  // structs in structs; LCM's types may be rings

Kind kind_of(const Member& member) {
  switch (member.wire) {
    case Wire::kBoolean:
      return Kind::kBoolean;
    case Wire::kFloat:
    case Wire::kDouble:
      return Kind::kReal;
    case Wire::kString:
      return Kind::kText;
    default:
      return Kind::kInteger;
  }
}

/// Walks one message along its type, and notes where it is.
class Builder {
 public:
  Builder(Layout& out, const std::uint8_t* data, std::size_t size) : out_(out), data_(data), size_(size) {}

  Fault whole(const StructType& type) {
    position_ = segment_begin_ = kBody;
    if (size_ < kBody + type.least_size) return Fault::kTooShort;
    if (size_ > std::numeric_limits<std::uint32_t>::max()) return Fault::kBadCount;
    const Fault fault = structure(type, "", 0);
    if (fault != Fault::kNone) return fault;
    out_.segment_sizes.push_back(here());
    return position_ == size_ ? Fault::kNone : Fault::kTrailing;
  }

 private:
  using Counts = std::vector<std::int64_t>;  // of a struct's members, 0 where one does not count

  std::size_t left() const { return size_ - position_; }
  std::uint32_t here() const { return static_cast<std::uint32_t>(position_ - segment_begin_); }

  Fault structure(const StructType& type, const std::string& prefix, int depth) {
    if (depth > kDeepest) return Fault::kBadCount;
    Counts counts(type.members.size(), 0);
    for (std::size_t i = 0; i < type.members.size(); ++i) {
      const Member& member = type.members[i];
      if (member.is_count) {
        if (left() < size_of(member.wire)) return Fault::kTooShort;
        counts[i] = read_integer(member.wire, data_ + position_);
        out_.counts.push_back({segment_, here(), member.wire, counts[i]});
      }
      const Fault fault = elements(member, counts, 0, prefix + member.name, 0, depth);
      if (fault != Fault::kNone) return fault;
    }
    return Fault::kNone;
  }

  /// All elements of a member from `dimension` on. @param flat index of the element in the member's list so
  /// far.
  Fault elements(const Member& member, const Counts& counts, std::size_t dimension, const std::string& path,
                 std::size_t flat, int depth) {
    if (dimension == member.dimensions.size()) return element(member, path, flat, depth);
    const Dimension& brackets = member.dimensions[dimension];
    const std::int64_t count = brackets.count_member < 0 ? brackets.fixed : counts[brackets.count_member];
    if (count < 0 || !fits(member, dimension, static_cast<std::size_t>(count)))
      return brackets.count_member < 0 ? Fault::kTooShort : Fault::kBadCount;
    const auto extent = static_cast<std::size_t>(count);
    if (member.wire == Wire::kByte && dimension + 1 == member.dimensions.size())
      return bytes(member, path, extent);
    for (std::size_t i = 0; i < extent; ++i) {
      const Fault fault = elements(member, counts, dimension + 1, path + "[" + std::to_string(i) + "]",
                                   flat * extent + i, depth);
      if (fault != Fault::kNone) return fault;
    }
    return Fault::kNone;
  }

  /// No more than the bytes can hold. An element of an outer dimension may be empty, but then not more of
  /// them than bytes either.
  bool fits(const Member& member, std::size_t dimension, std::size_t count) const {
    if (dimension + 1 < member.dimensions.size()) return count <= size_;
    const std::size_t least = member.wire == Wire::kStruct   ? member.type->least_size
                              : member.wire == Wire::kString ? 5
                                                             : size_of(member.wire);
    return count <= left() / (least == 0 ? 1 : least);
  }

  Fault element(const Member& member, const std::string& path, std::size_t flat, int depth) {
    if (member.wire == Wire::kStruct) return structure(*member.type, path + ".", depth + 1);
    if (member.wire == Wire::kString) return string(member, path);
    const std::size_t size = size_of(member.wire);
    if (left() < size) return Fault::kTooShort;
    Field field = field_of(member, path, kind_of(member), size);
    field.unit = unit_of(member.name, flat);
    if (member.enumeration != nullptr) field.text = member.enumeration->text;
    out_.fields.push_back(std::move(field));
    position_ += size;
    return Fault::kNone;
  }

  Fault bytes(const Member& member, const std::string& path, std::size_t size) {
    out_.fields.push_back(field_of(member, path, member.is_text ? Kind::kText : Kind::kBytes, size));
    position_ += size;
    return Fault::kNone;
  }

  Fault string(const Member& member, const std::string& path) {
    if (left() < 4) return Fault::kTooShort;
    const std::int64_t length = read_integer(Wire::kInt32, data_ + position_);
    const bool fits = length >= 1 && static_cast<std::size_t>(length) <= left() - 4;
    if (!fits || data_[position_ + 4 + static_cast<std::size_t>(length) - 1] != 0) return Fault::kBadText;
    out_.fields.push_back(field_of(member, path, Kind::kText, 0));
    out_.segment_sizes.push_back(here());
    position_ += 4 + static_cast<std::size_t>(length);
    segment_begin_ = position_;
    ++segment_;
    return Fault::kNone;
  }

  Field field_of(const Member& member, const std::string& path, Kind kind, std::size_t size) const {
    Field field;
    field.path = path;
    field.kind = kind;
    field.wire = member.wire;
    field.segment = segment_;
    field.offset = here();
    field.size = static_cast<std::uint32_t>(size);
    field.member = &member;
    return field;
  }

  Layout& out_;
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t position_ = 0;
  std::size_t segment_begin_ = 0;
  std::uint32_t segment_ = 0;
};

}  // namespace

std::shared_ptr<const Layout> build_layout(const StructType& type, const std::uint8_t* data, std::size_t size,
                                           Fault& fault) {
  auto layout = std::make_shared<Layout>();
  layout->type = &type;
  fault = Builder(*layout, data, size).whole(type);
  if (fault != Fault::kNone) return nullptr;
  layout->session = layout->find("session");
  layout->utime = layout->find("utime");
  layout->seq = layout->find("seq");
  return layout;
}

}  // namespace sprung::fields
