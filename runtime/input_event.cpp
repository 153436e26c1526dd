#include "runtime/input_event.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace sprung {

InputEvent::InputEvent() : fd_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (fd_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

InputEvent::~InputEvent() { close(fd_); }

void InputEvent::signal() noexcept {
  const std::uint64_t one = 1;
  // Fails only when the counter is full: then it is readable anyway.
  [[maybe_unused]] const auto written = write(fd_, &one, sizeof one);
}

void InputEvent::clear() noexcept {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto got = read(fd_, &count, sizeof count);  // nothing to read: already clear
}

}  // namespace sprung
