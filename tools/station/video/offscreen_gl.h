#pragma once
/// OpenGL without a screen, by EGL or OSMesa, whichever is there when the program runs: nothing is linked.
/// Shell: loads libraries.
#include <memory>

namespace sprung::station {

/// Current in the thread that made it until it is gone.
class OffscreenGl {
 public:
  virtual ~OffscreenGl() = default;
  virtual const char* by() const noexcept = 0;  ///< "EGL" or "OSMesa"
};

/// @throws std::runtime_error where neither is there or works: both reasons, and what to install.
std::unique_ptr<OffscreenGl> make_offscreen_gl(int width, int height);

}  // namespace sprung::station
