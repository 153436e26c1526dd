#include "tools/operate/launcher/terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>

namespace sprung {
namespace {

// ECMA-48, and xterm's second screen.
constexpr const char* kTake = "\x1b[?1049h\x1b[?25l";
constexpr const char* kGiveBack = "\x1b[?25h\x1b[?1049l";

const char* begin_of(LineStyle style) {
  switch (style) {
    case LineStyle::kHeading:
      return "\x1b[1m";
    case LineStyle::kBad:
      return "\x1b[31m";
    case LineStyle::kDim:
      return "\x1b[2m";
    case LineStyle::kPlain:
      break;
  }
  return "";
}

/// What a terminal does not take in time is lost: who watches over a robot does not wait for it.
void send(int terminal, const std::string& bytes) {
  constexpr int kTimeout_ms = 20;
  for (std::size_t done = 0; done < bytes.size();) {
    pollfd room{terminal, POLLOUT, 0};
    if (poll(&room, 1, kTimeout_ms) != 1) return;
    const ssize_t sent = write(terminal, bytes.data() + done, bytes.size() - done);
    if (sent <= 0) return;
    done += static_cast<std::size_t>(sent);
  }
}

/// Standard output once more, since not to wait is said of an opened file, and the shell has that one too.
int open_terminal() {
  const int terminal = open("/proc/self/fd/1", O_WRONLY | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  return terminal >= 0 ? terminal : fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 0);  // another user's terminal
}

/// Not with `&` behind it: the shell owns the terminal then, and would stop who changes its settings.
bool in_foreground() {
  const pid_t owner = tcgetpgrp(STDIN_FILENO);
  return owner < 0 || owner == getpgrp();
}

}  // namespace

bool has_terminal() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDOUT_FILENO) == 1 && isatty(STDIN_FILENO) == 1 && in_foreground() && kind != nullptr &&
         std::strcmp(kind, "dumb") != 0;
}

std::string drawing(const std::vector<ScreenLine>& lines) {
  std::string bytes = "\x1b[H";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string begin = begin_of(lines[i].style);
    bytes += begin + lines[i].text + (begin.empty() ? "" : "\x1b[0m") + "\x1b[K";
    if (i + 1 < lines.size()) bytes += "\r\n";
  }
  return bytes + "\x1b[J";
}

Terminal::Terminal() : terminal_(open_terminal()) {
  tcgetattr(STDIN_FILENO, &before_);
  termios quiet = before_;
  quiet.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON);
  quiet.c_iflag &= ~static_cast<tcflag_t>(IXON);
  quiet.c_cc[VSUSP] = quiet.c_cc[VQUIT] = _POSIX_VDISABLE;
  tcsetattr(STDIN_FILENO, TCSANOW, &quiet);
  send(terminal_, kTake);
}

Terminal::~Terminal() {
  send(terminal_, kGiveBack);
  close(terminal_);
  tcflush(STDIN_FILENO, TCIFLUSH);  // what was typed was not meant for the shell
  tcsetattr(STDIN_FILENO, TCSANOW, &before_);
}

Terminal::Size Terminal::size() const {
  winsize window{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0 || window.ws_row == 0) return {};
  return {window.ws_col, window.ws_row};
}

void Terminal::draw(const std::vector<ScreenLine>& lines) { send(terminal_, drawing(lines)); }

}  // namespace sprung
