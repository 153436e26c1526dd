#include "tools/operate/launcher/service_notify.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace sprung {

std::int64_t keep_alive_interval_us(const char* watchdog_usec, const char* watchdog_pid, std::int64_t pid) {
  if (watchdog_usec == nullptr) return 0;
  if (watchdog_pid != nullptr && std::atoll(watchdog_pid) != pid) return 0;
  return std::atoll(watchdog_usec) / 2;
}

ServiceNotify::ServiceNotify() {
  if (const char* socket = std::getenv("NOTIFY_SOCKET")) socket_ = socket;
  if (!socket_.empty())
    interval_us_ = keep_alive_interval_us(std::getenv("WATCHDOG_USEC"), std::getenv("WATCHDOG_PID"),
                                          getpid());
}

bool ServiceNotify::send(const std::string& state) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket_.empty() || socket_.size() >= sizeof address.sun_path) return false;
  std::memcpy(address.sun_path, socket_.data(), socket_.size());
  if (address.sun_path[0] == '@') address.sun_path[0] = '\0';  // a name that is no file
  const int fd = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return false;
  const auto length = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + socket_.size());
  const ssize_t sent = sendto(fd, state.data(), state.size(), MSG_NOSIGNAL,
                              reinterpret_cast<const sockaddr*>(&address), length);
  close(fd);
  return sent == static_cast<ssize_t>(state.size());
}

bool ServiceNotify::keep_alive(std::int64_t now_us) {
  if (interval_us_ <= 0 || now_us < next_us_) return false;
  next_us_ = now_us + interval_us_;
  return send("WATCHDOG=1");
}

}  // namespace sprung
