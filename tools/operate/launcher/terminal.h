#pragma once
/// The terminal as one screen that is drawn anew: the other lines of the session come back when it is left.
#include <termios.h>

#include <cstddef>
#include <string>
#include <vector>

#include "tools/operate/launcher/launch_screen.h"

namespace sprung {

/// Whether standard input and output are a terminal that can do this, and that is this process's to use.
bool has_terminal();

class Terminal {
 public:
  /// Takes the screen; typed characters are not shown. Ctrl-C alone still means something: Ctrl-Z, Ctrl-\ and
  /// Ctrl-S would leave a robot without its launcher.
  Terminal();
  ~Terminal();  ///< gives it back
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  struct Size {
    std::size_t width = 80;
    std::size_t height = 24;
  };
  Size size() const;  ///< as it is now
  /// Never waits long: on a terminal that takes nothing (a connection that hangs) the picture is not drawn.
  void draw(const std::vector<ScreenLine>& lines);

 private:
  int terminal_;
  termios before_{};
};

/// The bytes that show these lines from the top left corner and blank the rest. Pure.
std::string drawing(const std::vector<ScreenLine>& lines);

}  // namespace sprung
