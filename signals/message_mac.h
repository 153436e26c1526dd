#pragma once
/// The MAC with which messages end that move a robot (runtime/message_key.h says what it is over). A signal
/// has none: it is put on when a message is sent, and checked before one is decoded.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>

namespace sprung {

inline constexpr std::size_t kMacBytes = 16;

/// Whether message type M ends with one.
template <class M, class = void>
inline constexpr bool kHasMac = false;
template <class M>
inline constexpr bool kHasMac<M, std::void_t<decltype(M::mac)>> = true;

/// All zero, as of a message that nobody has sealed.
template <class M>
void clear_mac(M& message) noexcept {
  if constexpr (kHasMac<M>) std::fill(std::begin(message.mac), std::end(message.mac), std::uint8_t{0});
}

}  // namespace sprung
