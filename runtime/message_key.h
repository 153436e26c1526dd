#pragma once
/// The secret of one run, and what it proves: that a message comes from somebody who has it. The MAC is keyed
/// BLAKE2b with 16 bytes (RFC 7693; libsodium's crypto_generichash, Python's hashlib.blake2b) over the
/// channel's name, a zero byte, and the encoded message without its last 16 bytes, where the MAC stands.
/// Pure: where a key comes from is key_source.h's.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "signals/message_mac.h"

namespace sprung {

inline constexpr std::size_t kKeyBytes = 32;

class MessageKey {
 public:
  explicit MessageKey(const std::array<std::uint8_t, kKeyBytes>& bytes) noexcept : bytes_(bytes) {}
  ~MessageKey();  ///< leaves nothing of it in memory
  MessageKey(const MessageKey&) = delete;
  MessageKey& operator=(const MessageKey&) = delete;

  /// Writes the MAC into the last kMacBytes. @param size of the whole message, at least kMacBytes.
  void seal(std::string_view channel, std::uint8_t* message, std::size_t size) const noexcept;
  /// Whether the last kMacBytes are what seal() would write; takes equally long whichever byte differs.
  bool fits(std::string_view channel, const std::uint8_t* message, std::size_t size) const noexcept;

  const std::array<std::uint8_t, kKeyBytes>& bytes() const noexcept { return bytes_; }

 private:
  using Mac = std::array<std::uint8_t, kMacBytes>;
  Mac mac_of(std::string_view channel, const std::uint8_t* message, std::size_t size) const noexcept;
  std::array<std::uint8_t, kKeyBytes> bytes_;
};

}  // namespace sprung
