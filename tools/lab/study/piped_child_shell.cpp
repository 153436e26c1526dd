#include "tools/lab/study/piped_child_shell.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <stdexcept>

namespace sprung {
namespace {

constexpr int kReading = 0, kWriting = 1;

[[noreturn]] void not_started(const std::string& program, int why) {
  throw std::runtime_error(program + " cannot be started: " + std::strerror(why));
}

}  // namespace

PipedChild::PipedChild(std::vector<std::string> words) {
  int in[2], out[2];
  if (pipe2(in, O_CLOEXEC) != 0) not_started(words[0], errno);
  if (pipe2(out, O_CLOEXEC) != 0) {
    const int why = errno;
    close(in[kReading]);
    close(in[kWriting]);
    not_started(words[0], why);
  }
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in[kReading], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out[kWriting], STDOUT_FILENO);
  const int error = posix_spawn(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(in[kReading]);
  close(out[kWriting]);
  input_ = in[kWriting];
  output_ = out[kReading];
  std::signal(SIGPIPE, SIG_IGN);  // a child that has ended is an error of write(), not of this process
  if (error == 0) return;
  pid_ = -1;
  close(input_);
  close(output_);
  not_started(words[0], error);
}

PipedChild::~PipedChild() {
  end();
  close(input_);
  close(output_);
}

bool PipedChild::say(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t wrote = ::write(input_, text.data() + done, text.size() - done);
    if (wrote < 0 && errno == EINTR) continue;
    if (wrote <= 0) return false;
    done += static_cast<std::size_t>(wrote);
  }
  return true;
}

bool PipedChild::read_more() {
  char buffer[65536];
  ssize_t got = -1;
  do {
    got = ::read(output_, buffer, sizeof buffer);
  } while (got < 0 && errno == EINTR);
  if (got > 0) text_.append(buffer, static_cast<std::size_t>(got));
  return got > 0;
}

std::optional<std::string> PipedChild::line() {
  const std::size_t end = text_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = text_.substr(0, end);
  text_.erase(0, end + 1);
  return line;
}

std::string PipedChild::end() {
  if (pid_ > 0) kill(pid_, SIGKILL);
  return wait();
}

std::string PipedChild::wait() {
  if (pid_ <= 0) return "";
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return WIFSIGNALED(status) ? "killed by signal " + std::to_string(WTERMSIG(status))
                             : "exit status " + std::to_string(WEXITSTATUS(status));
}

}  // namespace sprung
