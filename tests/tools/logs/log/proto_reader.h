#pragma once
/// Reads protocol buffers' wire format, for tests; by the format's description, not by the writer's code.
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sprung::log {

struct ProtoValue {
  std::size_t field = 0;
  unsigned wire = 0;
  std::uint64_t number = 0;  ///< of wire types 0, 1, 5
  std::string bytes;         ///< of wire type 2
};

class ProtoReader {
 public:
  explicit ProtoReader(std::string_view bytes) : bytes_(bytes) {}
  bool done() const { return bytes_.empty(); }

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const auto byte = static_cast<std::uint8_t>(take(1)[0]);
      value |= std::uint64_t{byte & 0x7FU} << shift;
      if (byte < 0x80) return value;
    }
    throw std::runtime_error("a varint does not end");
  }
  std::uint64_t fixed(std::size_t size) {
    std::uint64_t value = 0;
    const std::string_view bytes = take(size);
    for (std::size_t i = size; i-- > 0;) value = value << 8U | static_cast<std::uint8_t>(bytes[i]);
    return value;
  }
  ProtoValue value() {
    ProtoValue out;
    const std::uint64_t tag = varint();
    out.field = tag >> 3U;
    out.wire = tag & 7U;
    if (out.wire == 0) out.number = varint();
    if (out.wire == 1) out.number = fixed(8);
    if (out.wire == 2) out.bytes = take(varint());
    if (out.wire == 5) out.number = fixed(4);
    if (out.wire > 2 && out.wire != 5) throw std::runtime_error("no such wire type");
    return out;
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > bytes_.size()) throw std::runtime_error("the message ends too soon");
    const std::string_view taken = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    return taken;
  }
  std::string_view bytes_;
};

inline std::vector<ProtoValue> proto_values(std::string_view message) {
  std::vector<ProtoValue> values;
  for (ProtoReader reader(message); !reader.done();) values.push_back(reader.value());
  return values;
}

/// Those of one field.
inline std::vector<ProtoValue> proto_values(std::string_view message, std::size_t field) {
  std::vector<ProtoValue> chosen;
  for (ProtoValue& value : proto_values(message)) {
    if (value.field == field) chosen.push_back(std::move(value));
  }
  return chosen;
}

/// The text or message that a field has first; "" where it has none.
inline std::string proto_bytes(std::string_view message, std::size_t field) {
  const auto values = proto_values(message, field);
  return values.empty() ? "" : values[0].bytes;
}

}  // namespace sprung::log
