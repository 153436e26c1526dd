#include "runtime/stop_request.h"

#include <sys/prctl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <system_error>

#include "runtime/input_event.h"

namespace sprung {
namespace {

std::atomic<bool> requested{false};
std::atomic<bool> looked_at{false};       // whether anybody here would notice a request
std::atomic<InputEvent*> event{nullptr};  // made once and kept: a signal may come at any time

extern "C" void on_stop_signal(int number) {
  const int saved_errno = errno;
  request_stop();
  if (!looked_at) {
    signal(number, SIG_DFL);
    raise(number);
  }
  errno = saved_errno;
}

}  // namespace

void install_stop_signals() {
  if (event.load() == nullptr) event = new InputEvent();
  struct sigaction action = {};
  action.sa_handler = on_stop_signal;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  struct sigaction hang_up = {};
  if (sigaction(SIGHUP, nullptr, &hang_up) == 0 && hang_up.sa_handler != SIG_IGN)  // nohup means what it says
    sigaction(SIGHUP, &action, nullptr);
  action.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &action, nullptr);
}

bool stop_requested() noexcept {
  looked_at = true;
  return requested.load();
}

int stop_fd() noexcept {
  looked_at = true;
  const InputEvent* const made = event.load();
  return made == nullptr ? -1 : made->fd();
}

void request_stop() noexcept {
  requested = true;
  if (InputEvent* const made = event.load(); made != nullptr) made->signal();
}

void clear_stop_request() noexcept {
  requested = looked_at = false;
  if (InputEvent* const made = event.load(); made != nullptr) made->clear();
}

void stop_with_parent(int parent_pid) {
  if (parent_pid == 0) parent_pid = getppid();
  if (prctl(PR_SET_PDEATHSIG, SIGTERM) != 0)
    throw std::system_error(errno, std::generic_category(), "PR_SET_PDEATHSIG");
  if (getppid() != parent_pid) request_stop();  // it ended before the line above
}

}  // namespace sprung
