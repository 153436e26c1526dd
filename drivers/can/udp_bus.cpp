#include "drivers/can/udp_bus.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "drivers/can/receive_controls.h"

namespace sprung {
namespace {

constexpr int kDatagramBatch = 32;
constexpr int kUdpBuffer_bytes = 4 << 20;  // what the kernel's limit allows of it: bursts must not be dropped

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("udp bus: " + what + ": " + std::strerror(errno));
}

void set_option(int fd, int level, int option, int value, const char* what) {
  if (::setsockopt(fd, level, option, &value, sizeof value) != 0) fail(what);
}

sockaddr_in address_of(in_addr host, int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr = host;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

in_addr loopback() {
  in_addr address{};
  address.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// A socket that closes itself, also when a constructor throws half-way.
class Socket {
 public:
  Socket() : fd_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    if (fd_ < 0) fail("cannot open a socket");
  }
  ~Socket() { ::close(fd_); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int fd() const noexcept { return fd_; }

 private:
  int fd_;
};

/// The loop device carries our frames; the default interface, where there is one, those of tools that do not
/// choose.
void join(int fd, in_addr group) {
  ip_mreq request{group, loopback()};
  if (::setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) != 0) {
    fail("cannot join the group on the loop device (ip link set lo up)");
  }
  request.imr_interface.s_addr = htonl(INADDR_ANY);
  (void)::setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request);
}

}  // namespace

struct UdpBus::Sockets {
  Socket receiver;
  Socket sender;  ///< its own port, so that our frames can be told from those of others
  sockaddr_in group{};
  std::uint16_t own_port = 0;
  KernelDrops drops;

  std::array<UdpDatagram, kDatagramBatch> datagrams;
  std::array<iovec, kDatagramBatch> vectors{};
  std::array<mmsghdr, kDatagramBatch> messages{};
  std::array<sockaddr_in, kDatagramBatch> sources{};
  alignas(cmsghdr) std::array<std::array<char, kReceiveControl_bytes>, kDatagramBatch> controls{};
  UtcOffset utc_offset;

  Sockets(in_addr group_address, int port) : group(address_of(group_address, port)) {
    open_receiver(group_address);
    open_sender();
  }

  void open_receiver(in_addr group_address) {
    set_option(receiver.fd(), SOL_SOCKET, SO_REUSEADDR, 1, "SO_REUSEADDR");
    set_option(receiver.fd(), SOL_SOCKET, SO_REUSEPORT, 1, "SO_REUSEPORT");
    set_option(receiver.fd(), SOL_SOCKET, SO_RCVBUF, kUdpBuffer_bytes, "SO_RCVBUF");
    if (!ask_for_receive_controls(receiver.fd())) fail("cannot ask for time stamps");
    if (::bind(receiver.fd(), reinterpret_cast<const sockaddr*>(&group), sizeof group) != 0)
      fail("cannot bind");
    join(receiver.fd(), group_address);
  }

  void open_sender() {
    set_option(sender.fd(), IPPROTO_IP, IP_MULTICAST_TTL, 0, "IP_MULTICAST_TTL");
    set_option(sender.fd(), IPPROTO_IP, IP_MULTICAST_LOOP, 1, "IP_MULTICAST_LOOP");
    const in_addr interface = loopback();
    if (::setsockopt(sender.fd(), IPPROTO_IP, IP_MULTICAST_IF, &interface, sizeof interface) != 0)
      fail("IP_MULTICAST_IF");
    sockaddr_in local = address_of(loopback(), 0);
    if (::bind(sender.fd(), reinterpret_cast<const sockaddr*>(&local), sizeof local) != 0)
      fail("cannot bind");
    socklen_t size = sizeof local;
    if (::getsockname(sender.fd(), reinterpret_cast<sockaddr*>(&local), &size) != 0)
      fail("cannot read own port");
    own_port = local.sin_port;
  }

  void prepare(int i, bool receiving) noexcept {
    const auto at = static_cast<std::size_t>(i);
    UdpDatagram& datagram = datagrams[at];
    vectors[at] = {datagram.bytes.data(), receiving ? UdpDatagram::kCapacity : datagram.size};
    msghdr& header = messages[at].msg_hdr;
    header = {};
    header.msg_iov = &vectors[at];
    header.msg_iovlen = 1;
    header.msg_name = receiving ? &sources[at] : &group;
    header.msg_namelen = sizeof(sockaddr_in);
    if (receiving) {
      header.msg_control = controls[at].data();
      header.msg_controllen = controls[at].size();
    }
  }
};

UdpBus::UdpBus(const std::string& group, int port) : group_(group), port_(port) {
  in_addr address{};
  if (::inet_pton(AF_INET, group.c_str(), &address) != 1 || !IN_MULTICAST(ntohl(address.s_addr))) {
    throw std::invalid_argument("udp bus: '" + group +
                                "' is no IPv4 multicast address (224.0.0.0 to 239.255.255.255)");
  }
  sockets_ = std::make_unique<Sockets>(address, port);
}

UdpBus::~UdpBus() = default;

int UdpBus::fd() const noexcept { return sockets_->receiver.fd(); }

std::string UdpBus::describe() const { return "udp:" + group_ + ":" + std::to_string(port_); }

bool UdpBus::send(const CanFrame* frames, int count) noexcept {
  std::array<StampedFrame, kDatagramBatch> stamped;
  bool all = true;
  for (int done = 0; done < count; done += kDatagramBatch) {
    const int batch = std::min(kDatagramBatch, count - done);
    for (int i = 0; i < batch; ++i) stamped[i] = {frames[done + i], 0.0};
    all = send_stamped(stamped.data(), batch) && all;
  }
  return all;
}

bool UdpBus::send_stamped(const StampedFrame* frames, int count) noexcept {
  int done = 0;
  while (done < count) {
    const int batch = std::min(kDatagramBatch, count - done);
    for (int i = 0; i < batch; ++i) {
      encode_datagram(frames[done + i], sockets_->datagrams[i]);
      sockets_->prepare(i, false);
    }
    const int sent = ::sendmmsg(sockets_->sender.fd(), sockets_->messages.data(),
                                static_cast<unsigned>(batch), MSG_DONTWAIT);
    if (sent <= 0) break;
    done += sent;
  }
  counters_.sent += done;
  counters_.send_failed += count - done;
  return done == count;
}

int UdpBus::receive(CanFrame* frames, int max) noexcept { return receive_timed(frames, nullptr, max); }

int UdpBus::receive_timed(CanFrame* frames, std::int64_t* arrival_us, int max) noexcept {
  std::array<StampedFrame, kDatagramBatch> stamped;
  int count = 0;
  while (count < max) {
    const int wanted = std::min(kDatagramBatch, max - count);
    const int got = receive_stamped(stamped.data(), wanted);
    for (int i = 0; i < got; ++i, ++count) {
      frames[count] = stamped[i].frame;
      if (arrival_us != nullptr) arrival_us[count] = stamped[i].arrival_us;
    }
    if (got < wanted) break;
  }
  return count;
}

int UdpBus::read_batch(int max) noexcept {
  const int batch = std::min(kDatagramBatch, max);
  for (int i = 0; i < batch; ++i) sockets_->prepare(i, true);
  sockets_->utc_offset.update();
  return ::recvmmsg(sockets_->receiver.fd(), sockets_->messages.data(), static_cast<unsigned>(batch),
                    MSG_DONTWAIT, nullptr);
}

bool UdpBus::take(int i, StampedFrame& frame) noexcept {
  const auto at = static_cast<std::size_t>(i);
  mmsghdr& message = sockets_->messages[at];
  const std::int64_t arrival_us = read_receive_controls(message.msg_hdr, sockets_->utc_offset.us(),
                                                        sockets_->drops);
  counters_.dropped = sockets_->drops.total;
  const sockaddr_in& source = sockets_->sources[at];
  if (source.sin_port == sockets_->own_port && source.sin_addr.s_addr == htonl(INADDR_LOOPBACK)) return false;
  if (!decode_datagram(sockets_->datagrams[at].bytes.data(), message.msg_len, frame)) {
    ++counters_.malformed;
    return false;
  }
  frame.arrival_us = arrival_us;
  return true;
}

int UdpBus::receive_stamped(StampedFrame* frames, int max) noexcept {
  int count = 0;
  while (count < max) {
    const int got = read_batch(max - count);
    if (got <= 0) break;
    for (int i = 0; i < got; ++i) count += take(i, frames[count]) ? 1 : 0;
  }
  counters_.received += count;
  return count;
}

}  // namespace sprung
