#include "tools/launcher/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

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

/// In the child: never returns. Reports errno through `report` when the program cannot be started.
[[noreturn]] void become(char* const* argv, pid_t launcher, int report) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() == launcher) {  // else the launcher died before the line above took hold
    execv(argv[0], argv);
    const int error = errno;
    [[maybe_unused]] const ssize_t written = write(report, &error, sizeof error);
  }
  _exit(127);
}

}  // namespace

ChildProcess::ChildProcess(const std::string& path, const std::vector<std::string>& arguments) {
  std::vector<char*> argv{const_cast<char*>(path.c_str())};
  for (const std::string& argument : arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  int report[2];
  if (pipe2(report, O_CLOEXEC) != 0) {
    throw std::runtime_error(std::string("no pipe: ") + std::strerror(errno));
  }
  const pid_t launcher = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    become(argv.data(), launcher, report[1]);
  }
  close(report[1]);
  int error = pid_ < 0 ? errno : 0;
  [[maybe_unused]] const ssize_t got = pid_ < 0 ? 0 : read(report[0], &error, sizeof error);
  close(report[0]);
  if (error != 0) {
    if (pid_ > 0) {
      waitpid(pid_, nullptr, 0);
    }
    throw std::runtime_error("cannot start " + path + ": " + std::strerror(error));
  }
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

int ChildProcess::stop(double patience_s) {
  signal(SIGTERM);
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience_s);
  while (!ended()) {
    if (std::chrono::steady_clock::now() > end) {
      kill(pid_, SIGKILL);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return *status_;
}

std::string system_program(const std::string& name, const std::string& package) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string candidate = folder + "/" + name;
    if (access(candidate.c_str(), X_OK) == 0) {
      return candidate;
    }
  }
  throw std::runtime_error(name + " is not installed: run ./setup, or apt-get install " + package);
}

std::string program_folder() {
  if (const char* folder = std::getenv("SPRUNG_PROGRAMS")) {
    return folder;
  }
  return std::filesystem::read_symlink("/proc/self/exe").parent_path().string();
}

}  // namespace sprung
