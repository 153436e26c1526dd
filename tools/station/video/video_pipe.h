#pragma once
/// ffmpeg that makes a video of pictures handed to it. Shell: starts a program.
#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sprung::station {

class VideoPipe {
 public:
  /// @throws std::runtime_error where ffmpeg is not installed, saying what to install.
  VideoPipe(const std::string& path, int width, int height, int frames_a_second);
  ~VideoPipe();
  VideoPipe(const VideoPipe&) = delete;
  VideoPipe& operator=(const VideoPipe&) = delete;

  /// @param rgb rows from the lowest up, as OpenGL gives them. @throws std::runtime_error where ffmpeg has
  /// ended.
  void add(const std::vector<std::uint8_t>& rgb);
  /// Waits until the file is written. @throws std::runtime_error where ffmpeg failed; what it said stands on
  /// standard error.
  void finish();

 private:
  std::string path_;
  int input_ = -1;
  pid_t pid_ = -1;
};

}  // namespace sprung::station
