#include "tools/logs/log/proto_message.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tools/logs/log/big_endian.h"
#include "tools/logs/log/proto_bytes.h"

namespace sprung::log {

namespace {

constexpr std::size_t kProtoShapesKept = 64;
constexpr std::size_t kFingerprint_bytes = 8;
constexpr std::size_t kReplaced = 3;  // bytes of U+FFFD, which may stand for one that is no UTF-8
constexpr std::size_t kDeepest = 40;  // a layout's structs in structs are fewer

std::uint64_t reversed(std::uint64_t value) noexcept { return __builtin_bswap64(value); }
std::uint32_t reversed(std::uint32_t value) noexcept { return __builtin_bswap32(value); }

/// LCM has the highest byte in front, protocol buffers the lowest.
template <class Unsigned>
char* put_reversed(std::size_t count, const std::uint8_t* from, char* to) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    Unsigned value = 0;
    std::memcpy(&value, from + i * sizeof value, sizeof value);
    value = reversed(value);
    std::memcpy(to + i * sizeof value, &value, sizeof value);
  }
  return to + count * sizeof(Unsigned);
}

char* put_sfixed32(std::int32_t value, char* to) noexcept {
  auto bits = static_cast<std::uint32_t>(value);
  for (int i = 0; i < 4; ++i, bits >>= 8U) *to++ = static_cast<char>(bits & 0xFFU);
  return to;
}

bool is_ascii(std::string_view text) noexcept {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return (static_cast<unsigned char>(c) & 0x80U) != 0; });
}

/// At most three times as long.
std::string valid_utf8(std::string_view text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace)).get<std::string>();
}

char* put_bytes(std::string_view bytes, char* to) noexcept {
  std::memcpy(to, bytes.data(), bytes.size());
  return to + bytes.size();
}

/// Up to its zero, with its length before it.
char* put_text(std::string_view bytes, char* to) {
  const std::string_view text = bytes.substr(0, bytes.find('\0'));
  if (is_ascii(text)) return put_bytes(text, put_varint(text.size(), to));
  const std::string valid = valid_utf8(text);
  return put_bytes(valid, put_varint(valid.size(), to));
}

/// Runs steps over a message's bytes, which a Decoder has checked.
class Run {
 public:
  Run(const std::uint8_t* from, char* to) noexcept : from_(from), to_(to) {}

  void take(const ProtoStep& step) {
    to_ = put_bytes(step.before, to_);
    switch (step.action) {
      case ProtoAction::kSwap8:
        to_ = put_reversed<std::uint64_t>(step.count, from_, to_);
        from_ += 8 * std::size_t{step.count};
        return;
      case ProtoAction::kSwap4:
        to_ = put_reversed<std::uint32_t>(step.count, from_, to_);
        from_ += 4 * std::size_t{step.count};
        return;
      case ProtoAction::kBytes:
        to_ = put_bytes(next(step.count), to_);
        return;
      case ProtoAction::kPaddedText:
        to_ = put_text(next(step.count), to_);
        return;
      case ProtoAction::kText:
        to_ = put_text(next(next_length()), to_);
        return;
      case ProtoAction::kBegin:
        begins_[depth_++] = to_++;
        return;
      case ProtoAction::kEnd:
        return end();
      default:
        for (std::uint32_t i = 0; i < step.count; ++i) take_small(step.action);
    }
  }

  char* end_of_output() const noexcept { return to_; }

 private:
  std::string_view next(std::size_t size) noexcept {
    const std::string_view bytes(reinterpret_cast<const char*>(from_), size);
    from_ += size;
    return bytes;
  }
  std::size_t next_length() noexcept {
    from_ += 4;
    return get_big_endian<std::uint32_t>(from_ - 4);
  }

  void take_small(ProtoAction action) noexcept {
    if (action == ProtoAction::kInt16To4) {
      to_ = put_sfixed32(static_cast<std::int16_t>(get_big_endian<std::uint16_t>(from_)), to_);
      from_ += 2;
      return;
    }
    const std::uint8_t value = *from_++;
    if (action == ProtoAction::kInt8To4) to_ = put_sfixed32(static_cast<std::int8_t>(value), to_);
    if (action == ProtoAction::kByteTo4) to_ = put_sfixed32(value, to_);
    if (action == ProtoAction::kBool) *to_++ = value != 0 ? 1 : 0;
  }

  /// Room for a length of one byte was left.
  void end() noexcept {
    char* const begin = begins_[--depth_];
    const auto size = static_cast<std::size_t>(to_ - begin - 1);
    const std::size_t length_size = varint_size(size);
    std::memmove(begin + length_size, begin + 1, size);
    put_varint(size, begin);
    to_ = begin + length_size + size;
  }

  const std::uint8_t* from_;
  char* to_;
  std::array<char*, kDeepest> begins_{};
  std::size_t depth_ = 0;
};

}  // namespace

const ProtoSteps& ProtoMessages::steps_of(const fields::MessageView& message) {
  const auto found = shapes_.find(message.layout());
  if (found != shapes_.end()) return found->second.steps;
  if (shapes_.size() >= kProtoShapesKept) shapes_.clear();
  Shape shape{message.keep_layout(), proto_steps(*message.layout())};
  return shapes_.emplace(message.layout(), std::move(shape)).first->second.steps;
}

std::string_view ProtoMessages::encode(const fields::MessageView& message, const void* data,
                                       std::size_t size) {
  const ProtoSteps& steps = steps_of(message);
  const std::size_t most = steps.bytes + kReplaced * size + kLongestVarint;
  if (buffer_.size() < most) buffer_.resize(most);
  Run run(static_cast<const std::uint8_t*>(data) + kFingerprint_bytes, buffer_.data());
  for (const ProtoStep& step : steps.steps) run.take(step);
  return {buffer_.data(), static_cast<std::size_t>(run.end_of_output() - buffer_.data())};
}

}  // namespace sprung::log
