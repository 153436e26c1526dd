#include "tools/station/video/video_pipe.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

#include "tools/operate/launcher/child_process.h"

namespace sprung::station {

namespace {

/// Starts a program that reads from the end of a pipe. @return its process; `input` is the other end.
pid_t start(std::vector<std::string> words, int& input) {
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  pid_t pid = -1;
  const int error = posix_spawn(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  input = ends[1];
  if (error != 0) throw std::runtime_error(words[0] + " cannot be started: " + std::strerror(error));
  return pid;
}

}  // namespace

VideoPipe::VideoPipe(const std::string& path, int width, int height, int frames_a_second) : path_(path) {
  const std::string program = system_program("ffmpeg", "ffmpeg", OfSetup::kNo);
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  std::signal(SIGPIPE, SIG_IGN);  // an ffmpeg that ends is an error of write(), not of this process
  pid_ = start({program, "-loglevel", "error", "-y", "-f", "rawvideo", "-pix_fmt", "rgb24", "-s", size, "-r",
                std::to_string(frames_a_second), "-i", "-", "-vf", "vflip", "-pix_fmt", "yuv420p", path},
               input_);
}

VideoPipe::~VideoPipe() {
  if (input_ >= 0) close(input_);
  if (pid_ > 0) waitpid(pid_, nullptr, 0);
}

void VideoPipe::add(const std::vector<std::uint8_t>& rgb) {
  for (std::size_t done = 0; done < rgb.size();) {
    const ssize_t written = write(input_, rgb.data() + done, rgb.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw std::runtime_error("ffmpeg has ended before " + path_ + " was complete");
    done += static_cast<std::size_t>(written);
  }
}

void VideoPipe::finish() {
  close(input_);
  input_ = -1;
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = -1;
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw std::runtime_error("ffmpeg could not write " + path_);
}

}  // namespace sprung::station
