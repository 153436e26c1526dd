#pragma once
/// What systemd wants to hear of a service of Type=notify: a datagram of KEY=VALUE lines to the socket named
/// in $NOTIFY_SOCKET (sd_notify(3)). Without that variable nothing is sent.
#include <cstdint>
#include <optional>
#include <string>

namespace sprung {

class ServiceNotify {
 public:
  ServiceNotify();  ///< reads $NOTIFY_SOCKET, $WATCHDOG_USEC and $WATCHDOG_PID
  /// @return whether systemd took it.
  bool send(const std::string& state);

  void ready(const std::string& status) { send("READY=1\nSTATUS=" + status); }
  void status(const std::string& status) { send("STATUS=" + status); }
  void stopping() { send("STOPPING=1"); }
  /// Call in every turn of the loop: says WATCHDOG=1 twice in the time that systemd waits for it.
  /// @return whether it did.
  bool keep_alive(std::int64_t now_us);

 private:
  std::string socket_;
  std::int64_t interval_us_ = 0;  ///< 0 = no watchdog
  std::int64_t next_us_ = 0;
};

/// Half of the watchdog's time; 0 where there is none or it is another process's. Pure.
std::int64_t keep_alive_interval_us(const char* watchdog_usec, const char* watchdog_pid, std::int64_t pid);

}  // namespace sprung
