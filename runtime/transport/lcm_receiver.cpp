#include "runtime/transport/lcm_receiver.h"

#include <arpa/inet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "runtime/session_clock.h"

namespace sprung {
namespace {

constexpr std::size_t kLargestDatagram = 65'536;  // UDP's own limit, and one
constexpr std::size_t kControl = CMSG_SPACE(sizeof(std::uint32_t)) + CMSG_SPACE(sizeof(timespec));

[[noreturn]] void fail(const LcmAddress& address, const std::string& what) {
  throw std::runtime_error("LCM on '" + address.url() + "': " + what + ": " + std::strerror(errno) +
                           "; without a multicast route run (as root) 'ip link set lo multicast on; ip route "
                           "add 239.0.0.0/8 dev lo', or look with 'sprung doctor'");
}

}  // namespace

struct LcmReceiver::Socket {
  explicit Socket(const LcmAddress& address)
      : fd(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)), bytes(kBatch * kLargestDatagram) {
    if (fd < 0) fail(address, "no socket");
    try {
      open(address);
    } catch (...) {
      close(fd);
      throw;
    }
  }
  ~Socket() { close(fd); }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  void set(const LcmAddress& address, int level, int option, int value, const char* what) const {
    if (setsockopt(fd, level, option, &value, sizeof value) != 0) fail(address, what);
  }

  void open(const LcmAddress& address) const {
    set(address, SOL_SOCKET, SO_REUSEADDR, 1, "SO_REUSEADDR");
    if (address.receive_buffer_bytes > 0)
      set(address, SOL_SOCKET, SO_RCVBUF, address.receive_buffer_bytes, "SO_RCVBUF");
    set(address, SOL_SOCKET, SO_TIMESTAMPNS, 1, "SO_TIMESTAMPNS");
    set(address, SOL_SOCKET, SO_RXQ_OVFL, 1, "SO_RXQ_OVFL");
    // Else a socket hears a group on every interface that any other program has joined it on.
    set(address, IPPROTO_IP, IP_MULTICAST_ALL, 0, "IP_MULTICAST_ALL");
    sockaddr_in group{};
    group.sin_family = AF_INET;
    group.sin_port = htons(address.port);
    inet_pton(AF_INET, address.group.c_str(), &group.sin_addr);
    if (bind(fd, reinterpret_cast<const sockaddr*>(&group), sizeof group) != 0) fail(address, "cannot bind");
    join(address, group.sin_addr);
  }

  /// LCM sends where the kernel's routes lead, with ttl=0 too: there what this machine says comes back.
  void join(const LcmAddress& address, in_addr group) const {
    ip_mreqn request{};
    request.imr_multiaddr = group;
    if (!address.interface.empty()) {
      request.imr_ifindex = static_cast<int>(if_nametoindex(address.interface.c_str()));
      if (request.imr_ifindex == 0) fail(address, "interface '" + address.interface + "'");
    }
    if (setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) != 0)
      fail(address, "cannot join the group");
    request.imr_ifindex = static_cast<int>(if_nametoindex("lo"));
    if (setsockopt(fd, IPPROTO_IP, IP_ADD_MEMBERSHIP, &request, sizeof request) != 0 && errno != EADDRINUSE)
      fail(address, "cannot join the group on lo");
  }

  void prepare(int i) noexcept {
    vectors[i] = {bytes.data() + static_cast<std::size_t>(i) * kLargestDatagram, kLargestDatagram};
    msghdr& header = messages[i].msg_hdr;
    header = {};
    header.msg_name = &sources[i];
    header.msg_namelen = sizeof sources[i];
    header.msg_iov = &vectors[i];
    header.msg_iovlen = 1;
    header.msg_control = controls[i].data();
    header.msg_controllen = controls[i].size();
  }

  /// @return when it arrived; also counts what the kernel lost before it.
  std::int64_t read_controls(int i, std::int64_t& lost) noexcept {
    std::int64_t arrival_utc_us = 0;
    msghdr& header = messages[i].msg_hdr;
    for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
      if (c->cmsg_level != SOL_SOCKET) continue;
      if (c->cmsg_type == SO_RXQ_OVFL) {
        std::uint32_t count = 0;
        std::memcpy(&count, CMSG_DATA(c), sizeof count);
        lost += static_cast<std::uint32_t>(count - lost_before);  // the kernel's counter wraps
        lost_before = count;
      } else if (c->cmsg_type == SCM_TIMESTAMPNS) {
        timespec at{};
        std::memcpy(&at, CMSG_DATA(c), sizeof at);
        arrival_utc_us = std::int64_t{at.tv_sec} * 1'000'000 + at.tv_nsec / 1000;
      }
    }
    return arrival_utc_us != 0 ? arrival_utc_us : utc_us();
  }

  const int fd;
  std::vector<std::uint8_t> bytes;
  std::array<iovec, kBatch> vectors{};
  std::array<mmsghdr, kBatch> messages{};
  std::array<sockaddr_in, kBatch> sources{};
  alignas(cmsghdr) std::array<std::array<char, kControl>, kBatch> controls{};
  std::uint32_t lost_before = 0;
};

LcmReceiver::LcmReceiver(const std::string& url, Fragments fragments)
    : socket_(std::make_unique<Socket>(LcmAddress::of(url))),
      senders_(LcmAddress::of(url).interface),
      fragments_(fragments) {}

LcmReceiver::~LcmReceiver() = default;

int LcmReceiver::fd() const noexcept { return socket_->fd; }

int LcmReceiver::read_batch() noexcept {
  for (int i = 0; i < kBatch; ++i) socket_->prepare(i);
  return recvmmsg(socket_->fd, socket_->messages.data(), kBatch, MSG_DONTWAIT, nullptr);
}

bool LcmReceiver::take(int i, ReceivedMessage& out) noexcept {
  try {
    return look_at(i, out);
  } catch (...) {
    return ++counts_.fragments, false;  // out of memory: only fragments take any
  }
}

bool LcmReceiver::look_at(int i, ReceivedMessage& out) {
  out.utc_us = socket_->read_controls(i, counts_.lost);
  const DatagramSender sender{socket_->sources[i].sin_addr.s_addr, socket_->sources[i].sin_port};
  if (!senders_.has(sender.address, out.utc_us)) return ++counts_.strangers, false;
  LcmPacket packet;
  const auto* const bytes = static_cast<const std::uint8_t*>(socket_->vectors[i].iov_base);
  if (parse_lcm_packet(bytes, socket_->messages[i].msg_len, packet) != PacketFault::kNone)
    return ++counts_.malformed, false;
  if (packet.fragment) return put_together(sender, packet, out);
  out.channel = packet.channel;
  out.data = packet.data;
  out.size = packet.size;
  return true;
}

bool LcmReceiver::put_together(const DatagramSender& sender, const LcmPacket& packet, ReceivedMessage& out) {
  if (fragments_ == Fragments::kRefused) return ++counts_.fragments, false;
  const std::int64_t refused = store_.refused();
  const FragmentStore::Message* const whole = store_.add(sender, packet, out.utc_us);
  counts_.fragments += store_.refused() - refused;
  if (whole == nullptr) return false;
  out.channel = whole->channel;
  out.data = whole->bytes.data();
  out.size = whole->bytes.size();
  return true;
}

}  // namespace sprung
