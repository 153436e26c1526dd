#pragma once
/// An LCM network of a test's own: multicast that stays on this machine, on a port that no other test uses at the time.
#include <unistd.h>

#include <cstdint>
#include <string>

#include "runtime/session_clock.h"

namespace sprung::test {

inline std::string own_lcm_url() {
  static int count = 0;
  const auto mixed = static_cast<std::uint64_t>(getpid()) * 2654435761U +
                     static_cast<std::uint64_t>(++count) * 40503U +
                     static_cast<std::uint64_t>(monotonic_us());
  return "udpm://239.255.76.68:" + std::to_string(20'000 + mixed % 40'000) + "?ttl=0&recv_buf_size=4194304";
}

}  // namespace sprung::test
