#pragma once
/// Wakes the one thread of a node when something came in. An eventfd, so that it can be polled together with
/// CAN sockets.
#include <cstdint>

namespace sprung {

class InputEvent {
 public:
  InputEvent();  ///< @throws std::system_error when the system has no descriptor left
  ~InputEvent();
  InputEvent(const InputEvent&) = delete;
  InputEvent& operator=(const InputEvent&) = delete;

  void signal() noexcept;  ///< from any thread or signal handler
  void clear() noexcept;   ///< before the inputs are looked at, so that none is overlooked
  int fd() const noexcept { return fd_; }

 private:
  int fd_;
};

}  // namespace sprung
