#include "drivers/can/can_bus.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "drivers/can/memory_bus.h"
#include "drivers/can/receive_controls.h"
#include "drivers/can/socketcan_bus.h"
#include "drivers/can/udp_bus.h"

namespace sprung {

int CanBus::receive_timed(CanFrame* frames, std::int64_t* arrival_us, int max) noexcept {
  const int count = receive(frames, max);
  std::fill_n(arrival_us, count, can_clock_us());
  return count;
}

int CanBus::receive_fd(CanFdFrame* /*frames*/, int /*max*/) noexcept { return 0; }

bool CanBus::accept_only(const CanFilter*, int) { return false; }

const char* text(CanSendError error) noexcept {
  switch (error) {
    case CanSendError::kNone:
      return "none";
    case CanSendError::kNoBuffers:
      return "the interface's queue is full (ENOBUFS)";
    case CanSendError::kLinkDown:
      return "link down";
    case CanSendError::kOther:
      break;
  }
  return "refused by the kernel";
}

namespace {

std::unique_ptr<CanBus> open_udp(const std::string& address, const std::string& rest) {
  const std::size_t colon = rest.rfind(':');
  int port = 0;
  if (colon != std::string::npos) {
    const char* end = rest.data() + rest.size();
    const auto [last, error] = std::from_chars(rest.data() + colon + 1, end, port);
    if (error == std::errc() && last == end && port > 0 && port < 65536) {
      return std::make_unique<UdpBus>(rest.substr(0, colon), port);
    }
  }
  throw std::invalid_argument("CAN bus '" + address +
                              "': expected udp:GROUP:PORT, e.g. udp:239.74.163.2:43113");
}

std::unique_ptr<CanBus> open_socketcan(const std::string& address, const std::string& rest) {
  const std::size_t question = rest.find('?');
  const bool fd = question != std::string::npos && rest.substr(question) == "?fd=1";
  if (question == 0 || (question != std::string::npos && !fd)) {
    throw std::invalid_argument("CAN bus '" + address +
                                "': expected socketcan:INTERFACE or socketcan:INTERFACE?fd=1");
  }
  return std::make_unique<SocketCanBus>(rest.substr(0, question), fd);
}

}  // namespace

std::unique_ptr<CanBus> open_can_bus(const std::string& address) {
  const std::size_t colon = address.find(':');
  const std::string kind = address.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : address.substr(colon + 1);
  if (colon != std::string::npos) {
    if (kind == "socketcan" && !rest.empty()) return open_socketcan(address, rest);
    if (kind == "udp") return open_udp(address, rest);
    if (kind == "memory") return std::make_unique<MemoryBus>(MemoryMedium::named(rest));
  }
  throw std::invalid_argument("CAN bus '" + address +
                              "': expected socketcan:INTERFACE, udp:GROUP:PORT or memory:NAME");
}

}  // namespace sprung
