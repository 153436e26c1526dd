#include "runtime/own_port.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>

namespace sprung {
namespace {

// Below Linux's range for ports that it hands out itself (32768 and up): one of those may be taken between
// our look and the first use.
constexpr int kFirst = 16'384, kCount = 16'384;
constexpr int kTries = 1'000;

/// A name in the kernel's abstract space (man 7 unix) is had by one socket at a time, and is gone with its
/// process, however that ends.
bool reserve(int port) {
  sockaddr_un name{};
  name.sun_family = AF_UNIX;
  const std::string text = "sprung-port-" + std::to_string(port);
  std::memcpy(name.sun_path + 1, text.data(), text.size());
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + text.size());
  const int fd = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) throw std::runtime_error("no socket for a port of one's own: too many open files?");
  const bool had = bind(fd, reinterpret_cast<const sockaddr*>(&name), size) == 0;
  if (!had) close(fd);
  return had;  // and the socket stays open
}

/// Whether no socket has the port, whoever made it.
bool unused(int port) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_ANY);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  const bool free = fd >= 0 && bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  if (fd >= 0) close(fd);
  return free;
}

}  // namespace

int own_port() {
  std::random_device device;
  for (int tries = 0; tries < kTries; ++tries) {
    const int port = kFirst + static_cast<int>(device() % kCount);
    if (unused(port) && reserve(port)) return port;
  }
  throw std::runtime_error("no UDP port is left between " + std::to_string(kFirst) + " and " +
                           std::to_string(kFirst + kCount) + ": what holds them? ss --udp --all");
}

}  // namespace sprung
