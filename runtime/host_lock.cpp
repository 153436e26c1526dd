#include "runtime/host_lock.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace sprung {
namespace {

struct Address {
  sockaddr_un socket{};
  socklen_t size = 0;
};

/// A first byte of zero makes it a name that is in no folder.
Address address_of(const std::string& name) {
  Address address;
  address.socket.sun_family = AF_UNIX;
  const std::string text = "sprung/" + name;
  const std::size_t length = std::min(text.size(), sizeof address.socket.sun_path - 1);
  std::memcpy(address.socket.sun_path + 1, text.data(), length);
  address.size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  return address;
}

const sockaddr* generic(const Address& address) { return reinterpret_cast<const sockaddr*>(&address.socket); }

/// Of who listens under the address; 0 = it does not say.
pid_t holder_of(const Address& address) {
  const int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  ucred holder{};
  socklen_t size = sizeof holder;
  const bool known = connect(fd, generic(address), address.size) == 0 &&
                     getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &holder, &size) == 0;
  close(fd);
  return known ? holder.pid : 0;
}

}  // namespace

HostLock::HostLock(const std::string& name, const std::string& whose)
    : fd_(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  const Address address = address_of(name);
  if (bind(fd_, generic(address), address.size) == 0 && listen(fd_, 1) == 0) return;
  const int error = errno;
  close(fd_);
  if (error != EADDRINUSE) throw std::runtime_error(whose + ": cannot be locked: " + std::strerror(error));
  const pid_t holder = holder_of(address);
  throw std::runtime_error(whose + " is in use by another process on this machine" +
                           (holder > 0 ? " (" + std::to_string(holder) + ")" : "") +
                           ": sprung down there first");
}

HostLock::~HostLock() {
  if (fd_ >= 0) close(fd_);
}

HostLock::HostLock(HostLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

}  // namespace sprung
