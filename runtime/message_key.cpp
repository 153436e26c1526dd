#include "runtime/message_key.h"

#include <sodium.h>

#include <algorithm>

namespace sprung {
namespace {

/// Chooses the processor's fastest BLAKE2b; without it the portable one is used, at half the speed.
const int kSodium = sodium_init();

}  // namespace

MessageKey::~MessageKey() { sodium_memzero(bytes_.data(), bytes_.size()); }

void MessageKey::seal(std::string_view channel, std::uint8_t* message, std::size_t size) const noexcept {
  const Mac mac = mac_of(channel, message, size);
  std::copy(mac.begin(), mac.end(), message + size - kMacBytes);
}

bool MessageKey::fits(std::string_view channel, const std::uint8_t* message,
                      std::size_t size) const noexcept {
  if (size < kMacBytes) return false;
  const Mac mac = mac_of(channel, message, size);
  return sodium_memcmp(mac.data(), message + size - kMacBytes, kMacBytes) == 0;
}

MessageKey::Mac MessageKey::mac_of(std::string_view channel, const std::uint8_t* message,
                                   std::size_t size) const noexcept {
  constexpr std::uint8_t kEndOfName = 0;
  crypto_generichash_state state;
  crypto_generichash_init(&state, bytes_.data(), bytes_.size(), kMacBytes);
  crypto_generichash_update(&state, reinterpret_cast<const std::uint8_t*>(channel.data()), channel.size());
  crypto_generichash_update(&state, &kEndOfName, 1);
  crypto_generichash_update(&state, message, size - kMacBytes);
  Mac mac;
  crypto_generichash_final(&state, mac.data(), mac.size());
  return mac;
}

}  // namespace sprung
