#pragma once
/// Bytes as a sequence of values, and the same sequence made: a target's seeds are written in the order in
/// which it reads. What is not there any more reads as zero.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace sprung::fuzz {

class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : left_(reinterpret_cast<const char*>(data), size) {}

  bool done() const { return left_.empty(); }
  /// Any plain number, in this machine's byte order; a double may be any bits.
  template <class T>
  T number() {
    T value{};
    const std::string_view bytes = text(sizeof value);
    std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }
  std::uint8_t byte() { return number<std::uint8_t>(); }
  /// At most so many.
  std::string_view text(std::size_t size) {
    const std::string_view taken = left_.substr(0, std::min(size, left_.size()));
    left_.remove_prefix(taken.size());
    return taken;
  }
  std::string_view rest() { return text(left_.size()); }
  /// A length of two bytes and so many bytes.
  std::string_view piece() { return text(number<std::uint16_t>()); }

 private:
  std::string_view left_;
};

class Output {
 public:
  template <class T>
  Output& number(T value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  Output& byte(int value) { return number(static_cast<std::uint8_t>(value)); }
  Output& text(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  Output& piece(std::string_view bytes) {
    return number(static_cast<std::uint16_t>(bytes.size())).text(bytes);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace sprung::fuzz
