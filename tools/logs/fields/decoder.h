#pragma once
/// Any message from its bytes. Malformed bytes give a fault, never more (LCM's own decoder ends the process:
/// facts L7).
///
///   Decoder decoder;                                  // types of lcmtypes/
///   MessageView message;                              // kept: no allocation while the shape stays
///   if (decoder.open(data, size, message) == Fault::kNone) {
///     // Another type or other counts: choose anew (field_choice.h).
///     if (message.layout() != last) chosen = choose(...);
///     for (const Field* field : chosen) row.push_back(message.number(*field));
///   }
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "signals/stamp.h"
#include "tools/logs/fields/layout.h"
#include "tools/logs/fields/type_table.h"

namespace sprung::fields {

/// A checked message. Looks at the bytes given to Decoder::open, which must stay as long as values are asked
/// for.
class MessageView {
 public:
  /// nullptr before the first message. The same pointer as before: the same fields at the same indices.
  const Layout* layout() const noexcept { return layout_.get(); }
  std::shared_ptr<const Layout> keep_layout() const noexcept { return layout_; }
  const std::vector<Field>& fields() const noexcept { return layout_->fields; }

  // `field` is one of fields().
  double number(
      const Field& field) const noexcept;  ///< of any kind of number, true is 1; NaN of texts and bytes
  std::int64_t integer(const Field& field) const noexcept;   ///< of kInteger and kBoolean; else 0
  std::string_view text(const Field& field) const noexcept;  ///< of kText, without the zero; else empty
  std::basic_string_view<std::uint8_t> bytes(
      const Field& field) const noexcept;  ///< as encoded; of a string its text with the zero
  const char* enumeration(
      const Field& field) const noexcept;  ///< name of an enumeration's value; nullptr of other fields

  std::int64_t session() const noexcept;        ///< 0 where the type has none
  std::optional<Stamp> stamp() const noexcept;  ///< nullopt where the type has none

 private:
  friend class Decoder;
  const std::uint8_t* at(const Field& field) const noexcept {
    return data_ + segment_begins_[field.segment] + field.offset;
  }

  std::shared_ptr<const Layout> layout_;
  const std::uint8_t* data_ = nullptr;
  std::vector<std::size_t> segment_begins_;
};

/// Keeps the shapes that it has met. Not to be shared between threads.
class Decoder {
 public:
  explicit Decoder(const TypeTable& types = TypeTable::sprung()) : types_(types) {}

  /// Unless kNone, `out` is unspecified and must not be asked for values.
  Fault open(const void* data, std::size_t size, MessageView& out);

 private:
  using Layouts = std::vector<std::shared_ptr<const Layout>>;  // the last one used in front
  bool try_layout(const std::shared_ptr<const Layout>& layout, std::size_t size, MessageView& out) const;

  const TypeTable& types_;
  std::unordered_map<std::int64_t, Layouts> layouts_;
};

}  // namespace sprung::fields
