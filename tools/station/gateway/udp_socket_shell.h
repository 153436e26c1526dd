#pragma once
/// A UDP socket of one end of the operator's link. Addresses are the kernel's, as bytes.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sprung::gateway {

/// "HOST", "HOST:PORT", "[::1]:PORT". @throws std::runtime_error on what is none.
struct HostPort {
  std::string host;
  int port = 0;
};
HostPort parse_host_port(const std::string& text, int usual_port);

class UdpSocket {
 public:
  /// Hears what is sent to this address. @throws std::runtime_error naming it where it cannot be had.
  static UdpSocket bound_to(const HostPort& own);
  /// Talks to one other end alone. @throws std::runtime_error where its name is not known.
  static UdpSocket connected_to(const HostPort& other);
  ~UdpSocket();
  UdpSocket(UdpSocket&& other) noexcept : fd_(other.fd_), buffer_(std::move(other.buffer_)) {
    other.fd_ = -1;
  }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;

  /// What has come. @param from set to who sent it. @return nothing where nothing has; valid until the next
  /// call.
  std::optional<std::string_view> receive(std::string& from);
  /// What the network does not take is lost. @param to of bound_to's.
  void send(std::string_view packet, const std::string& to);
  void send(std::string_view packet);
  /// @return whether something has come, within so many ms.
  bool wait(int timeout_ms) const;
  int fd() const noexcept { return fd_; }
  int port() const;  ///< own

 private:
  explicit UdpSocket(int fd);
  int fd_;
  std::string buffer_;
};

/// "10.0.0.2:41234", for people.
std::string address_text(const std::string& address);

}  // namespace sprung::gateway
