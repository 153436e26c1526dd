#include "drivers/can/socketcan_bus.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace sprung {
namespace {

/// Everything that says a bus is failing; not CAN_ERR_BUSERROR, which may flood (facts canopen section 5).
constexpr can_err_mask_t kErrorMask =
    CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_PROT | CAN_ERR_ACK | CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;

[[noreturn]] void fail(const std::string& interface, const std::string& what) {
  throw std::runtime_error("socketcan:" + interface + ": " + what + ": " + std::strerror(errno));
}

can_frame to_kernel(const CanFrame& frame) noexcept {
  can_frame raw{};
  raw.can_id = frame.id;
  raw.can_dlc = frame.length;
  std::copy(frame.data.begin(), frame.data.end(), raw.data);
  return raw;
}

/// @return false for extended and remote frames: nothing of ours uses them.
bool from_kernel(const can_frame& raw, CanFrame& frame) noexcept {
  frame.error = (raw.can_id & CAN_ERR_FLAG) != 0;
  if (!frame.error && (raw.can_id & (CAN_EFF_FLAG | CAN_RTR_FLAG)) != 0) return false;
  frame.id = raw.can_id & (frame.error ? CAN_ERR_MASK : CAN_SFF_MASK);
  frame.length = std::min<std::uint8_t>(raw.can_dlc, 8);
  std::copy(raw.data, raw.data + 8, frame.data.begin());
  return true;
}

}  // namespace

SocketCanBus::SocketCanBus(const std::string& interface) : interface_(interface) {
  fd_ = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  if (fd_ < 0) fail(interface, "this kernel has no CAN (modprobe can-raw, or use a udp: bus)");
  try {
    configure();
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

SocketCanBus::~SocketCanBus() { ::close(fd_); }

void SocketCanBus::configure() {
  const unsigned index = ::if_nametoindex(interface_.c_str());
  if (index == 0) fail(interface_, "no such interface (ip link show type can)");
  if (::setsockopt(fd_, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &kErrorMask, sizeof kErrorMask) != 0) {
    fail(interface_, "cannot ask for error frames");
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  if (::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    fail(interface_, "cannot bind (ip link set " + interface_ + " up)");
  }
}

bool SocketCanBus::send(const CanFrame* frames, int count) noexcept {
  for (int i = 0; i < count; ++i) {
    const can_frame raw = to_kernel(frames[i]);
    if (::write(fd_, &raw, sizeof raw) != static_cast<ssize_t>(sizeof raw)) {
      counters_.send_failed += count - i;
      return false;
    }
    ++counters_.sent;
  }
  return true;
}

int SocketCanBus::receive(CanFrame* frames, int max) noexcept {
  int count = 0;
  can_frame raw{};
  while (count < max) {
    const ssize_t got = ::read(fd_, &raw, sizeof raw);
    if (got < 0) break;
    if (got == static_cast<ssize_t>(sizeof raw) && from_kernel(raw, frames[count])) {
      ++count;
    } else {
      ++counters_.malformed;
    }
  }
  counters_.received += count;
  return count;
}

}  // namespace sprung
