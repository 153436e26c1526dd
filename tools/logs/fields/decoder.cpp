#include "tools/logs/fields/decoder.h"

#include <cstring>
#include <limits>
#include <utility>

namespace sprung::fields {

namespace {

constexpr std::size_t kFingerprint = 8;
constexpr std::size_t kMostLayouts = 32;  // of one type; more are forgotten

double real(Wire wire, const std::uint8_t* at) noexcept {
  if (wire == Wire::kFloat) {
    const auto bits = static_cast<std::uint32_t>(read_integer(Wire::kInt32, at));
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return static_cast<double>(value);
  }
  const std::int64_t bits = read_integer(Wire::kInt64, at);
  double value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// @return false where a count of this segment is not the layout's. @param next of layout.counts; moved
/// behind the segment's.
bool counts_agree(const Layout& layout, const std::uint8_t* segment, std::uint32_t index,
                  std::size_t& next) noexcept {
  for (; next < layout.counts.size() && layout.counts[next].segment == index; ++next) {
    const CountHere& count = layout.counts[next];
    if (read_integer(count.wire, segment + count.offset) != count.value) return false;
  }
  return true;
}

/// Bytes that the string at `at` takes, 0 unless it is whole.
std::size_t string_size(const std::uint8_t* at, std::size_t left) noexcept {
  if (left < 4) return 0;
  const std::int64_t length = read_integer(Wire::kInt32, at);
  if (length < 1 || static_cast<std::size_t>(length) > left - 4) return 0;
  return at[4 + length - 1] == 0 ? 4 + static_cast<std::size_t>(length) : 0;
}

}  // namespace

double MessageView::number(const Field& field) const noexcept {
  switch (field.kind) {
    case Kind::kReal:
      return real(field.wire, at(field));
    case Kind::kInteger:
    case Kind::kBoolean:
      return static_cast<double>(integer(field));
    default:
      return std::numeric_limits<double>::quiet_NaN();
  }
}

std::int64_t MessageView::integer(const Field& field) const noexcept {
  if (field.kind == Kind::kBoolean) return *at(field) != 0 ? 1 : 0;
  return field.kind == Kind::kInteger ? read_integer(field.wire, at(field)) : 0;
}

std::basic_string_view<std::uint8_t> MessageView::bytes(const Field& field) const noexcept {
  const std::uint8_t* const begin = at(field);
  if (field.wire != Wire::kString) return {begin, field.size};
  return {begin + 4, static_cast<std::size_t>(read_integer(Wire::kInt32, begin))};
}

std::string_view MessageView::text(const Field& field) const noexcept {
  if (field.kind != Kind::kText) return {};
  const auto raw = bytes(field);
  const std::string_view all(reinterpret_cast<const char*>(raw.data()), raw.size());
  return all.substr(0, all.find('\0'));
}

const char* MessageView::enumeration(const Field& field) const noexcept {
  return field.text == nullptr ? nullptr : field.text(static_cast<std::int8_t>(integer(field)));
}

std::int64_t MessageView::session() const noexcept {
  return layout_->session < 0 ? 0 : integer(fields()[layout_->session]);
}

std::optional<Stamp> MessageView::stamp() const noexcept {
  if (layout_->utime < 0 || layout_->seq < 0) return std::nullopt;
  return Stamp{integer(fields()[layout_->utime]), integer(fields()[layout_->seq])};
}

Fault Decoder::open(const void* data, std::size_t size, MessageView& out) {
  out.data_ = static_cast<const std::uint8_t*>(data);
  if (size < kFingerprint) return Fault::kTooShort;
  const std::int64_t hash = read_integer(Wire::kInt64, out.data_);
  Layouts& known = layouts_[hash];
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!try_layout(known[i], size, out)) continue;
    if (i > 0) std::swap(known[0], known[i]);
    return Fault::kNone;
  }
  const StructType* type = types_.by_hash(hash);
  if (type == nullptr) {
    layouts_.erase(hash);
    return Fault::kUnknownType;
  }
  Fault fault = Fault::kNone;
  const auto layout = build_layout(*type, out.data_, size, fault);
  if (layout == nullptr) return fault;
  if (known.size() >= kMostLayouts) known.pop_back();
  known.insert(known.begin(), layout);
  return try_layout(layout, size, out) ? Fault::kNone : Fault::kTooShort;
}

bool Decoder::try_layout(const std::shared_ptr<const Layout>& layout, std::size_t size,
                         MessageView& out) const {
  out.segment_begins_.resize(layout->segment_sizes.size());
  std::size_t position = kFingerprint;
  std::size_t next_count = 0;
  for (std::size_t i = 0; i < layout->segment_sizes.size(); ++i) {
    const std::size_t segment = layout->segment_sizes[i];
    if (size - position < segment) return false;
    if (!counts_agree(*layout, out.data_ + position, static_cast<std::uint32_t>(i), next_count)) return false;
    out.segment_begins_[i] = position;
    position += segment;
    if (i + 1 == layout->segment_sizes.size()) break;
    const std::size_t string = string_size(out.data_ + position, size - position);
    if (string == 0) return false;
    position += string;
  }
  if (position != size) return false;
  if (out.layout_ != layout) out.layout_ = layout;
  return true;
}

}  // namespace sprung::fields
