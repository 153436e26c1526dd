#include "tools/launcher/terminal.h"

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

void send(const std::string& bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t sent = write(STDOUT_FILENO, bytes.data() + done, bytes.size() - done);
    if (sent <= 0) return;
    done += static_cast<std::size_t>(sent);
  }
}

}  // namespace

bool has_terminal() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDOUT_FILENO) == 1 && isatty(STDIN_FILENO) == 1 && kind != nullptr &&
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

Terminal::Terminal() {
  tcgetattr(STDIN_FILENO, &before_);
  termios quiet = before_;
  quiet.c_lflag &= ~static_cast<tcflag_t>(ECHO | ICANON);
  tcsetattr(STDIN_FILENO, TCSANOW, &quiet);
  send(kTake);
}

Terminal::~Terminal() {
  send(kGiveBack);
  tcsetattr(STDIN_FILENO, TCSAFLUSH, &before_);
}

Terminal::Size Terminal::size() const {
  winsize window{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &window) != 0 || window.ws_col == 0 || window.ws_row == 0) return {};
  return {window.ws_col, window.ws_row};
}

void Terminal::draw(const std::vector<ScreenLine>& lines) { send(drawing(lines)); }

}  // namespace sprung
