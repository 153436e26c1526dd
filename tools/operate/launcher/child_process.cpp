#include "tools/operate/launcher/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace sprung {

namespace {

constexpr int kPipeBytes = 1 << 20;  // some seconds of a talkative process, should the launcher stall

/// Both ends without waiting: {read, write}, or {-1, -1} where nothing is captured.
std::array<int, 2> output_pipe(Output output) {
  std::array<int, 2> ends{-1, -1};
  if (output == Output::kInherited) return ends;
  if (pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0)
    throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  fcntl(ends[1], F_SETPIPE_SZ, kPipeBytes);  // refused where the user has too many: then it is smaller
  return ends;
}

/// In the child: never returns. Reports errno through `report` when the program cannot be started.
[[noreturn]] void become(char* const* argv, pid_t launcher, int report, int output, int inherited) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (output >= 0) {
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
  }
  if (inherited >= 0) fcntl(inherited, F_SETFD, 0);
  if (getppid() == launcher) {  // else the launcher died before the line above took hold
    execv(argv[0], argv);
    const int error = errno;
    [[maybe_unused]] const ssize_t written = write(report, &error, sizeof error);
  }
  _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::string& path, const std::vector<std::string>& arguments, Output output,
                           int inherited_fd) {
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  }
  const std::array<int, 2> captured = output_pipe(output);
  output_fd_ = captured[0];
  const pid_t launcher = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    become(argv.data(), launcher, report[1], captured[1], inherited_fd);
  }
  close(report[1]);
  if (captured[1] >= 0) close(captured[1]);
  int error = pid_ < 0 ? errno : 0;
  [[maybe_unused]] const ssize_t got = pid_ < 0 ? 0 : read(report[0], &error, sizeof error);
  close(report[0]);
  if (error != 0) {
    if (pid_ > 0) {
      waitpid(pid_, nullptr, 0);
    }
    if (output_fd_ >= 0) close(output_fd_);
    throw std::runtime_error("cannot start " + path + ": " + std::strerror(error));
  }
}

ChildProcess::~ChildProcess() {
  if (output_fd_ >= 0) close(output_fd_);
}

std::string ChildProcess::output() {
  std::string text;
  std::array<char, 4096> part;
  while (output_fd_ >= 0) {
    const ssize_t got = read(output_fd_, part.data(), part.size());
    if (got <= 0) break;
    text.append(part.data(), static_cast<std::size_t>(got));
  }
  return text;
}

std::optional<int> ChildProcess::ended() {
  int raw = 0;
  if (!status_ && waitpid(pid_, &raw, WNOHANG) == pid_) {
    status_ = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
  }
  return status_;
}

void ChildProcess::signal(int number) {
  if (!ended()) {
    kill(pid_, number);
  }
}

bool ChildProcess::wait(double timeout_s) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  while (!ended() && std::chrono::steady_clock::now() < end)
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  return ended().has_value();
}

int ChildProcess::stop(double timeout_s) {
  signal(SIGTERM);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(timeout_s);
  while (!ended()) {
    if (std::chrono::steady_clock::now() > end) {
      kill(pid_, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return *status_;
}

std::string system_program(const std::string& name, const std::string& package, OfSetup setup) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::string candidate = folder + "/" + name;
    if (access(candidate.c_str(), X_OK) == 0) {
      return candidate;
    }
  }
  throw std::runtime_error(name + " is not installed: " + (setup == OfSetup::kYes ? "run ./setup, or " : "") +
                           "apt-get install " + package);
}

std::string program_folder() {
  if (const char* folder = std::getenv("SPRUNG_PROGRAMS")) {
    return folder;
  }
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

}  // namespace sprung
