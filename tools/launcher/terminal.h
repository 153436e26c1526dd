#pragma once
/// The terminal as one screen that is drawn anew: the other lines of the session come back when it is left.
#include <termios.h>

#include <cstddef>
#include <string>
#include <vector>

#include "tools/launcher/launch_screen.h"

namespace sprung {

/// Whether standard output is a terminal that can do this.
bool has_terminal();

class Terminal {
 public:
  Terminal();   ///< takes the screen; typed characters are not shown
  ~Terminal();  ///< gives it back
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  struct Size {
    std::size_t width = 80;
    std::size_t height = 24;
  };
  Size size() const;  ///< as it is now
  void draw(const std::vector<ScreenLine>& lines);

 private:
  termios before_{};
};

/// The bytes that show these lines from the top left corner and blank the rest. Pure.
std::string drawing(const std::vector<ScreenLine>& lines);

}  // namespace sprung
