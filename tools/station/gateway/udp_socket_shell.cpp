#include "tools/station/gateway/udp_socket_shell.h"

#include <fcntl.h>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace sprung::gateway {
namespace {

constexpr std::size_t kLongestDatagram = 65536;
constexpr int kBuffer = 1 << 20;

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Addresses look_up(const HostPort& at, int flags) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_DGRAM;
  hints.ai_flags = flags | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error = getaddrinfo(at.host.c_str(), std::to_string(at.port).c_str(), &hints, &found);
  if (error != 0) throw std::runtime_error("address '" + at.host + "': " + gai_strerror(error));
  return {found, &freeaddrinfo};
}

int opened(const addrinfo& address) {
  const int fd = socket(address.ai_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) throw std::runtime_error(std::string("socket: ") + std::strerror(errno));
  setsockopt(fd, SOL_SOCKET, SO_RCVBUF, &kBuffer, sizeof kBuffer);
  setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &kBuffer, sizeof kBuffer);
  return fd;
}

}  // namespace

HostPort parse_host_port(const std::string& text, int usual_port) {
  HostPort out{text, usual_port};
  const std::size_t colon = text.rfind(':'), bracket = text.rfind(']');
  const bool one_colon = colon != std::string::npos && text.find(':') == colon;
  const bool bracketed = !text.empty() && text[0] == '[' && bracket != std::string::npos;
  std::string port;
  if (bracketed) {
    out.host = text.substr(1, bracket - 1);
    if (colon == bracket + 1) port = text.substr(colon + 1);
  } else if (one_colon) {
    out.host = text.substr(0, colon);
    port = text.substr(colon + 1);
  }
  const bool digits = port.find_first_not_of("0123456789") == std::string::npos && port.size() <= 5;
  if (!port.empty() && digits) out.port = std::stoi(port);
  if (out.host.empty() || !digits || out.port > 65535)
    throw std::runtime_error("'" + text + "' is no HOST or HOST:PORT");
  return out;
}

UdpSocket::UdpSocket(int fd) : fd_(fd), buffer_(kLongestDatagram, '\0') {}

UdpSocket UdpSocket::bound_to(const HostPort& own) {
  const Addresses found = look_up(own, AI_PASSIVE);
  UdpSocket out(opened(*found));
  if (bind(out.fd_, found->ai_addr, found->ai_addrlen) != 0)
    throw std::runtime_error(own.host + ":" + std::to_string(own.port) +
                             " cannot be had: " + std::strerror(errno) + ". Does a gateway run already?");
  return out;
}

UdpSocket UdpSocket::connected_to(const HostPort& other) {
  const Addresses found = look_up(other, 0);
  UdpSocket out(opened(*found));
  if (connect(out.fd_, found->ai_addr, found->ai_addrlen) != 0)
    throw std::runtime_error("no way to " + other.host + ": " + std::strerror(errno));
  return out;
}

UdpSocket::~UdpSocket() {
  if (fd_ >= 0) close(fd_);
}

std::optional<std::string_view> UdpSocket::receive(std::string& from) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  const ssize_t size = recvfrom(fd_, buffer_.data(), buffer_.size(), 0, reinterpret_cast<sockaddr*>(&address),
                                &length);
  if (size < 0) return std::nullopt;  // nothing there, or word that an earlier one did not arrive
  from.assign(reinterpret_cast<const char*>(&address), length);
  return std::string_view(buffer_).substr(0, static_cast<std::size_t>(size));
}

void UdpSocket::send(std::string_view packet, const std::string& to) {
  sendto(fd_, packet.data(), packet.size(), MSG_DONTWAIT | MSG_NOSIGNAL,
         reinterpret_cast<const sockaddr*>(to.data()), static_cast<socklen_t>(to.size()));
}

void UdpSocket::send(std::string_view packet) {
  ::send(fd_, packet.data(), packet.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
}

bool UdpSocket::wait(int timeout_ms) const {
  pollfd in{fd_, POLLIN, 0};
  return poll(&in, 1, timeout_ms) > 0;
}

int UdpSocket::port() const {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &length);
  const std::string text = address_text(std::string(reinterpret_cast<const char*>(&address), length));
  return std::stoi(text.substr(text.rfind(':') + 1));
}

std::string address_text(const std::string& address) {
  char host[NI_MAXHOST], port[NI_MAXSERV];
  if (getnameinfo(reinterpret_cast<const sockaddr*>(address.data()), static_cast<socklen_t>(address.size()),
                  host, sizeof host, port, sizeof port, NI_NUMERICHOST | NI_NUMERICSERV) != 0)
    return "?";
  return std::string(host) + ":" + port;
}

}  // namespace sprung::gateway
