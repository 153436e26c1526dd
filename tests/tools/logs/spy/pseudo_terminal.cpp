#include "tests/tools/logs/spy/pseudo_terminal.h"

#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <stdexcept>

namespace sprung::test {

namespace {

using Clock = std::chrono::steady_clock;

constexpr unsigned char kEscape = 27;

Clock::time_point after(double seconds) {
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

[[noreturn]] void become(const std::vector<std::string>& command) {
  setenv("TERM", "vt52", 1);
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  _exit(127);
}

}  // namespace

PseudoTerminal::PseudoTerminal(const std::vector<std::string>& command)
    : cells_(kRows, std::vector<std::string>(kColumns, " ")) {
  winsize size{};
  size.ws_row = kRows;
  size.ws_col = kColumns;
  pid_ = forkpty(&terminal_, nullptr, nullptr, &size);
  if (pid_ < 0) throw std::runtime_error("no pseudo terminal");
  if (pid_ == 0) become(command);
}

PseudoTerminal::~PseudoTerminal() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  close(terminal_);
}

void PseudoTerminal::press(const std::string& keys) {
  if (write(terminal_, keys.data(), keys.size()) != static_cast<ssize_t>(keys.size()))
    throw std::runtime_error("the terminal takes no keys");
}

bool PseudoTerminal::sees(const std::string& wanted, double timeout_s) {
  const Clock::time_point end = after(timeout_s);
  while (screen().find(wanted) == std::string::npos) {
    if (Clock::now() > end) return false;
    read_some(50);
  }
  return true;
}

int PseudoTerminal::ends(double timeout_s) {
  const Clock::time_point end = after(timeout_s);
  int status = 0;
  while (waitpid(pid_, &status, WNOHANG) == 0) {
    if (Clock::now() > end) return -1;
    if (!read_some(20)) usleep(20'000);
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string PseudoTerminal::screen() const {
  std::string out;
  for (const auto& row : cells_) {
    std::string line;
    for (const std::string& cell : row) line += cell;
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

bool PseudoTerminal::read_some(int timeout_ms) {
  pollfd wait{terminal_, POLLIN, 0};
  unsigned char bytes[4096];
  if (poll(&wait, 1, timeout_ms) <= 0) return false;
  const ssize_t count = read(terminal_, bytes, sizeof bytes);
  for (ssize_t i = 0; i < count; ++i) put(bytes[i]);
  return count > 0;
}

void PseudoTerminal::put(unsigned char byte) {
  if (!escape_.empty()) {
    escape_ += static_cast<char>(byte);
    const bool position = escape_[1] == 'Y';
    if (position && escape_.size() < 4) return;
    if (position) {
      row_ = static_cast<unsigned char>(escape_[2]) - ' ';
      column_ = byte - ' ';
    } else {
      command(byte);
    }
    escape_.clear();
  } else if (byte == kEscape) {
    escape_ += static_cast<char>(byte);
  } else {
    text(byte);
  }
  row_ = std::clamp(row_, 0, kRows - 1);
  column_ = std::clamp(column_, 0, kColumns);
}

void PseudoTerminal::command(unsigned char letter) {
  if (letter == 'A') --row_;
  if (letter == 'B') ++row_;
  if (letter == 'C') ++column_;
  if (letter == 'D') --column_;
  if (letter == 'H') row_ = column_ = 0;
  if (letter == 'K') std::fill(cells_[row_].begin() + std::min(column_, kColumns), cells_[row_].end(), " ");
  if (letter == 'J') clear_to_end();
}

void PseudoTerminal::clear_to_end() {
  std::fill(cells_[row_].begin() + std::min(column_, kColumns), cells_[row_].end(), " ");
  for (int row = row_ + 1; row < kRows; ++row) std::fill(cells_[row].begin(), cells_[row].end(), " ");
}

void PseudoTerminal::text(unsigned char byte) {
  if (byte == '\r') {
    column_ = 0;
  } else if (byte == '\n') {
    ++row_;
  } else if (byte == '\b') {
    --column_;
  } else if ((byte & 0xC0U) == 0x80U) {  // goes on with a letter
    if (letter_fits_ && column_ > 0) cells_[row_][column_ - 1] += static_cast<char>(byte);
  } else if (byte >= ' ') {
    letter_fits_ = column_ < kColumns;
    if (letter_fits_) cells_[row_][column_++] = static_cast<char>(byte);
  }
}

}  // namespace sprung::test
