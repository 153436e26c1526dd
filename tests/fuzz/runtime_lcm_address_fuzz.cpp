/// The text behind --lcm-url.
#include <stdexcept>

#include "runtime/transport/lcm_address.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::runtime_lcm_address {
namespace {

std::vector<std::string> address_seeds() {
  return {"udpm://239.255.76.67:7667?ttl=0",
          "udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304&interface=eth0", "udpm://", "file://x",
          "udpm://224.0.0.1:65536"};
}

}  // namespace

SPRUNG_FUZZ(runtime_lcm_address, address_seeds) {
  try {
    const LcmAddress address = LcmAddress::of(std::string(input.rest()));
    const LcmAddress again = LcmAddress::of(address.url());
    require(again.group == address.group && again.port == address.port && again.ttl == address.ttl,
            "comes back");
    require(again.receive_buffer_bytes == address.receive_buffer_bytes, "comes back");
  } catch (const std::invalid_argument&) {  // that is how mistakes are told
  }
}

}  // namespace sprung::fuzz::runtime_lcm_address
