#pragma once
/// A log as a video of the robot, drawn by MuJoCo. Shell: reads the log and the robot's files, writes a file.
#include <string>
#include <vector>

#include "tools/logs/log/log_info.h"
#include "tools/logs/log/reader.h"

namespace sprung::station {

struct VideoOptions {
  int width = 1280, height = 720;  ///< px, even
  int frames_a_second = 30;
  double speed = 1.0;  ///< 0.25: four times as slow as it was
};

struct VideoResult {
  std::size_t pictures = 0;
  std::vector<std::string> notes;  ///< messages of another version, of which nothing is drawn
};

/// Begins where the log first says where a joint is. @param path x.mp4, or another ending that ffmpeg knows.
/// @throws std::runtime_error where OpenGL or ffmpeg is missing, saying what to install; where the log has no
/// robot, no model or no pose, also since its messages are of another version.
VideoResult write_video(log::Reader& reader, const std::string& path, const VideoOptions& options);

}  // namespace sprung::station
