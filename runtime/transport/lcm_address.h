#pragma once
/// Where an LCM network is: "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304". One option is ours and
/// not LCM's: `interface=eth0` also hears the hosts of that network, for robots with several computers.
#include <cstdint>
#include <string>

namespace sprung {

struct LcmAddress {
  std::string group;  ///< an IPv4 multicast address
  std::uint16_t port = 0;
  int ttl = 0;                   ///< 0 = nothing leaves this machine
  int receive_buffer_bytes = 0;  ///< 0 = the system's default
  std::string interface;         ///< empty = this machine alone is heard

  /// @throws std::invalid_argument that says what is wrong with the url and what it should look like.
  static LcmAddress of(const std::string& url);
  std::string url() const;  ///< for LCM itself: without `interface`
};

}  // namespace sprung
