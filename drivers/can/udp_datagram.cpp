#include "drivers/can/udp_datagram.h"

#include <cstring>
#include <exception>
#include <msgpack.hpp>
#include <string_view>

namespace sprung {
namespace {

/// Where msgpack's packer writes; the capacity is larger than the largest frame.
struct FixedStream {
  UdpDatagram& datagram;
  void write(const char* bytes, std::size_t count) noexcept {
    if (datagram.size + count > UdpDatagram::kCapacity) return;
    std::memcpy(datagram.bytes.data() + datagram.size, bytes, count);
    datagram.size += count;
  }
};

using Packer = msgpack::packer<FixedStream>;

void pack_key(Packer& packer, std::string_view key) {
  packer.pack_str(static_cast<std::uint32_t>(key.size()));
  packer.pack_str_body(key.data(), static_cast<std::uint32_t>(key.size()));
}

void pack_flag(Packer& packer, std::string_view key, bool value) {
  pack_key(packer, key);
  if (value) {
    packer.pack_true();
  } else {
    packer.pack_false();
  }
}

/// msgpack's own packer turns whole numbers into integers; python-can sends float64 always.
void pack_float64(FixedStream& stream, double value) noexcept {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof bits);
  std::array<char, 9> bytes{static_cast<char>(0xCB)};
  for (std::size_t i = 0; i < 8; ++i) bytes[i + 1] = static_cast<char>((bits >> (56 - 8 * i)) & 0xFF);
  stream.write(bytes.data(), bytes.size());
}

/// Fields that a classic frame must have, with python-can's defaults for what is missing.
struct Fields {
  StampedFrame stamped;
  std::uint64_t id = 0;
  std::uint64_t dlc = 0;
  bool has_id = false;
  bool has_dlc = false;
  bool extended = true;
  bool fd = false;
};

bool read_data(const msgpack::object& value, CanFrame& frame) {
  if (value.type != msgpack::type::BIN || value.via.bin.size > frame.data.size()) return false;
  frame.length = static_cast<std::uint8_t>(value.via.bin.size);
  std::memcpy(frame.data.data(), value.via.bin.ptr, value.via.bin.size);
  return true;
}

/// @throws msgpack::type_error on a value of another type.
bool read_field(std::string_view key, const msgpack::object& value, Fields& fields) {
  if (key == "timestamp") {
    fields.stamped.timestamp = value.as<double>();
  } else if (key == "arbitration_id") {
    fields.id = value.as<std::uint64_t>();
    fields.has_id = true;
  } else if (key == "is_extended_id") {
    fields.extended = value.as<bool>();
  } else if (key == "is_remote_frame") {
    fields.stamped.frame.remote = value.as<bool>();
  } else if (key == "is_error_frame") {
    fields.stamped.frame.error = value.as<bool>();
  } else if (key == "dlc") {
    fields.dlc = value.as<std::uint64_t>();
    fields.has_dlc = true;
  } else if (key == "data") {
    return read_data(value, fields.stamped.frame);
  } else if (key == "is_fd") {
    fields.fd = value.as<bool>();
  } else {
    return key == "channel" || key == "bitrate_switch" || key == "error_state_indicator";
  }
  return true;
}

bool read_map(const msgpack::object& object, Fields& fields) {
  if (object.type != msgpack::type::MAP) return false;
  for (std::uint32_t i = 0; i < object.via.map.size; ++i) {
    const msgpack::object_kv& entry = object.via.map.ptr[i];
    if (entry.key.type != msgpack::type::STR) return false;
    if (!read_field({entry.key.via.str.ptr, entry.key.via.str.size}, entry.val, fields)) return false;
  }
  return true;
}

/// A remote frame has the length that it asks for and no data, whatever came along, as in python-can.
/// @return false when the fields are no classic 11-bit frame.
bool finish(Fields& fields) noexcept {
  CanFrame& frame = fields.stamped.frame;
  if (!fields.has_id || fields.id > 0x7FF || fields.extended || fields.fd) return false;
  frame.id = static_cast<std::uint32_t>(fields.id);
  if (!frame.remote) return !fields.has_dlc || fields.dlc == frame.length;
  if (frame.error || fields.dlc > frame.data.size()) return false;
  frame.data = {};
  frame.length = static_cast<std::uint8_t>(fields.dlc);
  return true;
}

}  // namespace

void encode_datagram(const StampedFrame& stamped, UdpDatagram& datagram) noexcept {
  const CanFrame& frame = stamped.frame;
  const std::uint32_t data_size = frame.remote ? 0 : frame.length;
  datagram.size = 0;
  FixedStream stream{datagram};
  Packer packer(stream);
  packer.pack_map(11);
  pack_key(packer, "timestamp");
  pack_float64(stream, stamped.timestamp);
  pack_key(packer, "arbitration_id");
  packer.pack_uint32(frame.id);
  pack_flag(packer, "is_extended_id", false);
  pack_flag(packer, "is_remote_frame", frame.remote);
  pack_flag(packer, "is_error_frame", frame.error);
  pack_key(packer, "channel");
  packer.pack_nil();
  pack_key(packer, "dlc");
  packer.pack_uint8(frame.length);
  pack_key(packer, "data");
  packer.pack_bin(data_size);
  packer.pack_bin_body(reinterpret_cast<const char*>(frame.data.data()), data_size);
  pack_flag(packer, "is_fd", false);
  pack_flag(packer, "bitrate_switch", false);
  pack_flag(packer, "error_state_indicator", false);
}

bool decode_datagram(const char* bytes, std::size_t size, StampedFrame& frame) noexcept {
  // Bounds for a hostile datagram: 32 entries, 64 bytes a string, no nesting beyond the map.
  const msgpack::unpack_limit limit(0, 32, 64, 64, 0, 2);
  try {
    std::size_t used = 0;
    const msgpack::object_handle handle = msgpack::unpack(bytes, size, used, nullptr, nullptr, limit);
    Fields fields;
    if (used != size || !read_map(handle.get(), fields) || !finish(fields)) return false;
    frame = fields.stamped;
    return true;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace sprung
