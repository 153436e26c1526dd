#include "drivers/can/socketcan_bus.h"

#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "drivers/can/kernel_frame.h"
#include "drivers/can/receive_controls.h"
#include "drivers/can/send_confirmations.h"

namespace sprung {
namespace {

constexpr int kFrameBatch = 32;
constexpr std::size_t kMostFdFrames = 1024;  // that wait to be fetched
/// What the kernel's limit allows of it: a stall must not lose frames.
constexpr int kSocketBuffer_bytes = 1 << 20;

/// Everything that says a bus is failing; not CAN_ERR_BUSERROR, which may flood (facts canopen section 5).
constexpr can_err_mask_t kErrorMask = CAN_ERR_TX_TIMEOUT | CAN_ERR_CRTL | CAN_ERR_PROT | CAN_ERR_ACK |
                                      CAN_ERR_BUSOFF | CAN_ERR_RESTARTED;

[[noreturn]] void fail(const std::string& interface, const std::string& what) {
  throw std::runtime_error("socketcan:" + interface + ": " + what + ": " + std::strerror(errno));
}

}  // namespace

struct SocketCanBus::Socket {
  int fd = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  std::vector<can_filter> filters{{0, 0}};  ///< as the kernel has them: everything passes
  KernelDrops drops;
  SendConfirmations confirmations;
  /// Of both kinds: a classic one is the beginning of such a frame (linux/can.h).
  std::array<canfd_frame, kFrameBatch> frames{};
  std::size_t longest = CAN_MTU;  ///< that is received; longer ones of FD do not come
  std::array<iovec, kFrameBatch> vectors{};
  std::array<mmsghdr, kFrameBatch> messages{};
  alignas(cmsghdr) std::array<std::array<char, kReceiveControl_bytes>, kFrameBatch> controls{};
  UtcOffset utc_offset;

  Socket() = default;
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  ~Socket() { ::close(fd); }

  void prepare(int i, bool receiving) noexcept {
    const auto at = static_cast<std::size_t>(i);
    vectors[at] = {&frames[at], receiving ? longest : CAN_MTU};
    msghdr& header = messages[at].msg_hdr;
    header = {};
    header.msg_iov = &vectors[at];
    header.msg_iovlen = 1;
    if (receiving) {
      header.msg_control = controls[at].data();
      header.msg_controllen = controls[at].size();
    }
  }
  template <class Value>
  bool set(int level, int option, const Value& value) noexcept {
    return ::setsockopt(fd, level, option, &value, sizeof value) == 0;
  }
};

SocketCanBus::SocketCanBus(const std::string& interface, bool hears_fd)
    : interface_(interface), hears_fd_(hears_fd), socket_(std::make_unique<Socket>()) {
  if (socket_->fd < 0) fail(interface, "this kernel has no CAN (modprobe can-raw, or use a udp: bus)");
  configure();
}

SocketCanBus::~SocketCanBus() = default;

int SocketCanBus::fd() const noexcept { return socket_->fd; }

void SocketCanBus::configure() {
  if (::if_nametoindex(interface_.c_str()) == 0) {
    fail(interface_, "no such interface (ip link show type can)");
  }
  if (!socket_->set(SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kErrorMask)) {
    fail(interface_, "cannot ask for error frames");
  }
  if (!socket_->set(SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, 1)) fail(interface_, "cannot ask for confirmations");
  if (!ask_for_receive_controls(socket_->fd)) fail(interface_, "cannot ask for time stamps");
  (void)socket_->set(SOL_SOCKET, SO_RCVBUF, kSocketBuffer_bytes);
  if (hears_fd_) ask_for_fd();
  if (!bind_interface()) fail(interface_, "cannot bind (ip link set " + interface_ + " up)");
}

void SocketCanBus::ask_for_fd() {
  ifreq request{};
  std::strncpy(request.ifr_name, interface_.c_str(), sizeof request.ifr_name - 1);
  if (::ioctl(socket_->fd, SIOCGIFMTU, &request) != 0) fail(interface_, "cannot be asked for its MTU");
  if (request.ifr_mtu != static_cast<int>(CANFD_MTU)) {
    throw std::runtime_error("socketcan:" + interface_ + "?fd=1: a classic interface (ip link set " +
                             interface_ + " type can ... fd on, or leave ?fd=1 out)");
  }
  if (!socket_->set(SOL_CAN_RAW, CAN_RAW_FD_FRAMES, 1)) fail(interface_, "cannot ask for CAN FD frames");
  socket_->longest = CANFD_MTU;
}

bool SocketCanBus::bind_interface() noexcept {
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(::if_nametoindex(interface_.c_str()));
  if (address.can_ifindex == 0) return false;  // 0 would bind to every interface
  return ::bind(socket_->fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

bool SocketCanBus::set_filters() noexcept {
  const auto bytes = static_cast<socklen_t>(socket_->filters.size() * sizeof(can_filter));
  return ::setsockopt(socket_->fd, SOL_CAN_RAW, CAN_RAW_FILTER, socket_->filters.data(), bytes) == 0;
}

bool SocketCanBus::accept_only(const CanFilter* filters, int count) {
  filters_.assign(filters, filters + count);
  socket_->filters.clear();  // remote requests pass like data, extended identifiers do not
  for (const CanFilter& filter : filters_)
    socket_->filters.push_back({filter.id, filter.mask | CAN_EFF_FLAG});
  if (socket_->filters.empty()) socket_->filters.push_back({0, 0});
  return set_filters();
}

bool SocketCanBus::send(const CanFrame* frames, int count) noexcept {
  last_send_error_ = CanSendError::kNone;
  int done = 0;
  bool tried_again = false;
  while (done < count) {
    const int sent = send_batch(frames + done, std::min(kFrameBatch, count - done));
    if (sent > 0) {
      done += sent;
    } else if (const int error = errno; tried_again || !worth_another_try(error)) {
      count_failure(error, count - done);
      break;
    } else {
      tried_again = true;
    }
  }
  counters_.sent += done;
  return done == count;
}

int SocketCanBus::send_batch(const CanFrame* frames, int count) noexcept {
  for (int i = 0; i < count; ++i) {
    const can_frame raw = to_kernel(frames[i]);
    std::memcpy(&socket_->frames[i], &raw, sizeof raw);
    socket_->prepare(i, false);
  }
  const std::int64_t now_us = can_clock_us();
  const int sent = ::sendmmsg(socket_->fd, socket_->messages.data(), static_cast<unsigned>(count),
                              MSG_DONTWAIT);
  const int filter_count = static_cast<int>(filters_.size());
  for (int i = 0; i < sent; ++i) {
    if (passes(filters_.data(), filter_count, frames[i].id)) socket_->confirmations.sent(frames[i], now_us);
  }
  return sent;
}

/// A link that went down leaves one error on the socket, which the first call after it gets even when the
/// link is up again. An interface that was removed takes the filters with it, and has to be bound anew.
bool SocketCanBus::worth_another_try(int error) noexcept {
  if (error == ENETDOWN) return true;
  if ((error != ENODEV && error != ENXIO) || !bind_interface() || !set_filters()) return false;
  int left = 0;
  socklen_t size = sizeof left;
  ::getsockopt(socket_->fd, SOL_SOCKET, SO_ERROR, &left, &size);  // reading it clears it
  return true;
}

void SocketCanBus::count_failure(int error, int frames) noexcept {
  counters_.send_failed += frames;
  if (error == ENOBUFS || error == EAGAIN) {
    last_send_error_ = CanSendError::kNoBuffers;
    counters_.no_buffers += frames;
  } else if (error == ENETDOWN || error == ENODEV || error == ENXIO) {
    last_send_error_ = CanSendError::kLinkDown;
    counters_.link_down += frames;
    socket_->confirmations.forget();
  } else {
    last_send_error_ = CanSendError::kOther;
  }
}

int SocketCanBus::receive(CanFrame* frames, int max) noexcept { return receive_timed(frames, nullptr, max); }

int SocketCanBus::receive_timed(CanFrame* frames, std::int64_t* arrival_us, int max) noexcept {
  int count = 0;
  while (count < max) {
    const int wanted = std::min(kFrameBatch, max - count);
    const int got = read_batch(wanted);
    for (int i = 0; i < got; ++i) {
      std::int64_t time_us = 0;
      if (!take(i, frames[count], time_us)) continue;
      if (arrival_us != nullptr) arrival_us[count] = time_us;
      ++count;
    }
    if (got < wanted) break;
  }
  counters_.received += count;
  return count;
}

int SocketCanBus::read_batch(int max) noexcept {
  for (int i = 0; i < max; ++i) socket_->prepare(i, true);
  socket_->utc_offset.update();
  const auto read = [this, max] {
    return ::recvmmsg(socket_->fd, socket_->messages.data(), static_cast<unsigned>(max), MSG_DONTWAIT,
                      nullptr);
  };
  const int got = read();
  return got < 0 && errno != EAGAIN ? read() : got;  // see worth_another_try()
}

bool SocketCanBus::take(int i, CanFrame& frame, std::int64_t& arrival_us) noexcept {
  const auto at = static_cast<std::size_t>(i);
  msghdr& header = socket_->messages[at].msg_hdr;
  arrival_us = read_receive_controls(header, socket_->utc_offset.us(), socket_->drops);
  counters_.dropped = socket_->drops.total;
  if (socket_->messages[at].msg_len == CANFD_MTU) {
    ++counters_.fd_frames;
    if (fd_frames_.size() == kMostFdFrames) fd_frames_.pop_front();
    fd_frames_.push_back(fd_from_kernel(socket_->frames[at]));
    return false;
  }
  can_frame raw;
  std::memcpy(&raw, &socket_->frames[at], sizeof raw);
  if (socket_->messages[at].msg_len != CAN_MTU || !from_kernel(raw, frame)) {
    ++counters_.malformed;
    return false;
  }
  if ((header.msg_flags & MSG_CONFIRM) != 0) {
    count_confirmation(frame, arrival_us);
    return false;
  }
  if (frame.error && (frame.id & CAN_ERR_BUSOFF) != 0) socket_->confirmations.forget();
  return true;
}

int SocketCanBus::receive_fd(CanFdFrame* frames, int max) noexcept {
  int count = 0;
  for (; count < max && !fd_frames_.empty(); ++count) {
    frames[count] = fd_frames_.front();
    fd_frames_.pop_front();
  }
  return count;
}

void SocketCanBus::count_confirmation(const CanFrame& frame, std::int64_t arrival_us) noexcept {
  ++counters_.confirmed;
  const std::int64_t waited_us = socket_->confirmations.confirmed(frame, arrival_us);
  if (waited_us == SendConfirmations::kUnknown) return;
  counters_.confirmation_us = waited_us;
  counters_.longest_confirmation_us = std::max(counters_.longest_confirmation_us, waited_us);
}

}  // namespace sprung
