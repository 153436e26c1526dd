#pragma once
/// Lines on a terminal and keys from it, by ncurses.
#include <cstddef>
#include <vector>

#include "tools/logs/spy/spy_view.h"

namespace sprung::spy {

class SpyTerminal {
 public:
  /// Takes the terminal over. @throws std::runtime_error where standard input or output is none, or TERM is
  /// not known.
  SpyTerminal();
  ~SpyTerminal();  ///< gives it back as it was
  SpyTerminal(const SpyTerminal&) = delete;
  SpyTerminal& operator=(const SpyTerminal&) = delete;

  std::size_t width() const noexcept;
  std::size_t height() const noexcept;
  void show(const std::vector<Line>& lines);
  /// Waits for a key; kNone after `timeout_ms`, or when the window changed its size.
  KeyPress key(int timeout_ms);

 private:
  struct Screen;
  Screen* screen_;
};

}  // namespace sprung::spy
