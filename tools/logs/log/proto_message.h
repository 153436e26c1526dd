#pragma once
/// Any message in protocol buffers' encoding, as proto_schema.h describes it. Pure.
#include <cstddef>
#include <memory>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tools/logs/fields/decoder.h"
#include "tools/logs/log/proto_steps.h"

namespace sprung::log {

/// Every member is written, zeros too; lists without elements are left out. Numbers keep their bits, NaN too.
/// In texts, bytes that are no UTF-8 become U+FFFD, since readers refuse a message with such a text.
class ProtoMessages {
 public:
  /// @param message what a Decoder made of `data`. @return valid until the next call.
  std::string_view encode(const fields::MessageView& message, const void* data, std::size_t size);

 private:
  struct Shape {
    std::shared_ptr<const fields::Layout> layout;  ///< kept, so that no other gets its address
    ProtoSteps steps;
  };
  const ProtoSteps& steps_of(const fields::MessageView& message);

  std::unordered_map<const fields::Layout*, Shape> shapes_;
  std::vector<char> buffer_;
};

}  // namespace sprung::log
