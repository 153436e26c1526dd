#include "tools/logs/log/proto_steps.h"

#include <utility>

#include "tools/logs/log/proto_types.h"

namespace sprung::log {

namespace {

constexpr std::size_t kLongestLength = 5;  // of a text or message: LCM counts in 32 bits

ProtoAction action_of(fields::Wire wire) noexcept {
  using fields::Wire;
  switch (wire) {
    case Wire::kInt8:
      return ProtoAction::kInt8To4;
    case Wire::kInt16:
      return ProtoAction::kInt16To4;
    case Wire::kInt32:
    case Wire::kFloat:
      return ProtoAction::kSwap4;
    case Wire::kInt64:
    case Wire::kDouble:
      return ProtoAction::kSwap8;
    case Wire::kByte:
      return ProtoAction::kByteTo4;
    case Wire::kBoolean:
      return ProtoAction::kBool;
    default:
      return ProtoAction::kNothing;
  }
}

/// Steps of a stretch of a message, and literal bytes behind the last of them.
struct Piece {
  std::vector<ProtoStep> steps;
  std::string tail;
  std::size_t bytes = 0;  ///< that come out, literal ones too; at most, where it varies
  bool varies = false;

  void tag(std::size_t field, ProtoWire wire) {
    const std::size_t before = tail.size();
    append_tag(field, wire, tail);
    bytes += tail.size() - before;
  }
  void length(std::size_t value) {
    append_varint(value, tail);
    bytes += varint_size(value);
  }
  void act(ProtoAction action, std::size_t count, std::size_t most_bytes) {
    steps.push_back({std::exchange(tail, {}), action, static_cast<std::uint32_t>(count)});
    bytes += most_bytes;
  }
  void act_of_any_length(ProtoAction action, std::size_t count) {
    act(action, count, kLongestLength);
    varies = true;
  }
  void append(const Piece& piece) {
    for (const ProtoStep& step : piece.steps)
      steps.push_back({std::exchange(tail, {}) + step.before, step.action, step.count});
    tail += piece.tail;
    bytes += piece.bytes;
    varies |= piece.varies;
  }
};

/// Walks a type as the layout's counts say, which is how build_layout() walked it.
class Compiler {
 public:
  explicit Compiler(const fields::Layout& layout) : next_count_(layout.counts.begin()) {}

  Piece structure(const fields::StructType& type) {
    Piece out;
    Counts counts(type.members.size(), 0);
    for (std::size_t i = 0; i < type.members.size(); ++i) {
      const fields::Member& member = type.members[i];
      if (member.is_count) counts[i] = static_cast<std::size_t>((next_count_++)->value);
      append_member(member, i + 1, counts, out);
    }
    return out;
  }

 private:
  using Counts = std::vector<std::size_t>;

  static std::size_t extent(const fields::Dimension& dimension, const Counts& counts) {
    return dimension.count_member < 0 ? static_cast<std::size_t>(dimension.fixed)
                                      : counts[dimension.count_member];
  }

  void append_member(const fields::Member& member, std::size_t number, const Counts& counts, Piece& out) {
    const bool lists_bytes = member.wire == fields::Wire::kByte && !member.dimensions.empty();
    std::size_t elements = 1;
    for (std::size_t i = 0; i + (lists_bytes ? 1 : 0) < member.dimensions.size(); ++i)
      elements *= extent(member.dimensions[i], counts);
    const ProtoField field = proto_field(member);
    if (proto_size(field.type) > 0) return append_numbers(member, number, field, elements, out);
    const std::size_t bytes = lists_bytes ? extent(member.dimensions.back(), counts) : 0;
    for (std::size_t i = 0; i < elements; ++i) {
      out.tag(number, ProtoWire::kLength);
      if (member.wire == fields::Wire::kStruct) {
        append_struct(*member.type, out);
      } else if (lists_bytes) {
        append_bytes(field.type, bytes, out);
      } else {
        out.act_of_any_length(ProtoAction::kText, 0);
      }
    }
  }

  static void append_numbers(const fields::Member& member, std::size_t number, const ProtoField& field,
                             std::size_t elements, Piece& out) {
    if (elements == 0) return;
    const std::size_t bytes = elements * proto_size(field.type);
    out.tag(number, field.repeated ? ProtoWire::kLength : proto_wire(field.type));
    if (field.repeated) out.length(bytes);
    out.act(action_of(member.wire), elements, bytes);
  }

  static void append_bytes(ProtoType type, std::size_t bytes, Piece& out) {
    if (type == ProtoType::kString) return out.act_of_any_length(ProtoAction::kPaddedText, bytes);
    out.length(bytes);
    out.act(ProtoAction::kBytes, bytes, bytes);
  }

  void append_struct(const fields::StructType& type, Piece& out) {
    const Piece inner = structure(type);
    const bool varies = inner.varies;
    if (varies) {
      out.act_of_any_length(ProtoAction::kBegin, 0);
    } else {
      out.length(inner.bytes);
    }
    out.append(inner);
    if (varies) out.act(ProtoAction::kEnd, 0, 0);
  }

  std::vector<fields::CountHere>::const_iterator next_count_;
};

}  // namespace

ProtoSteps proto_steps(const fields::Layout& layout) {
  Piece all = Compiler(layout).structure(*layout.type);
  if (!all.tail.empty()) all.act(ProtoAction::kNothing, 0, 0);  // an empty list's or struct's tag
  return {std::move(all.steps), all.bytes};
}

}  // namespace sprung::log
