#pragma once
/// A name that one process of this host holds, whatever folders its user has: an abstract Unix socket, which
/// the kernel takes away with the process. Such names are a network namespace's, as CAN interfaces are.
#include <string>

namespace sprung {

class HostLock {
 public:
  /// @throws std::runtime_error when another process holds `name`, with `whose` ("bus leg (socketcan:can0)")
  /// and its process id.
  HostLock(const std::string& name, const std::string& whose);
  ~HostLock();
  HostLock(HostLock&& other) noexcept;
  HostLock(const HostLock&) = delete;
  HostLock& operator=(const HostLock&) = delete;
  HostLock& operator=(HostLock&&) = delete;

 private:
  int fd_ = -1;
};

}  // namespace sprung
