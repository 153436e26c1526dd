#pragma once
/// An LCM network of a test's own: multicast that stays on this machine, on a port that nobody else has.
#include <string>

#include "runtime/own_port.h"

namespace sprung::test {

inline std::string own_lcm_url() {
  return "udpm://239.255.76.68:" + std::to_string(own_port()) + "?ttl=0&recv_buf_size=4194304";
}

}  // namespace sprung::test
