#pragma once
/// One child of the launcher. It gets its own process group, so that Ctrl-C reaches the launcher alone and
/// the stop order holds, and it dies with the launcher whatever happens to that.
#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace sprung {

/// Where standard output and error of a child go.
enum class Output {
  kInherited,
  /// Into a pipe that output() empties. What does not fit is lost: a control loop never waits for its
  /// launcher.
  kCaptured,
};

class ChildProcess {
 public:
  /// @throws std::runtime_error when the program cannot be started, naming it.
  /// @param inherited_fd stays open in it, under the same number; -1 = none.
  ChildProcess(const std::string& path, const std::vector<std::string>& arguments,
               Output output = Output::kInherited, int inherited_fd = -1);
  ~ChildProcess();  ///< of the handle; the process itself is not touched
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  /// Exit status when it has ended: 0..255, or 128 + signal; nullopt while it runs.
  std::optional<int> ended();
  void signal(int number);
  /// Whether it ends by itself within that time.
  bool wait(double timeout_s);
  /// SIGTERM, wait, SIGKILL after timeout_s. @return exit status as in ended().
  int stop(double timeout_s);
  /// What a captured child has written since the last call; never waits.
  std::string output();

 private:
  int output_fd_ = -1;
  pid_t pid_ = -1;
  std::optional<int> status_;
};

/// Whether ./setup installs a package.
enum class OfSetup : bool { kNo, kYes };

/// A program of the system, from $PATH. @throws std::runtime_error naming it and saying what to install.
std::string system_program(const std::string& name, const std::string& package,
                           OfSetup setup = OfSetup::kYes);

/// Where the stack's programs are: $SPRUNG_PROGRAMS, else the folder of the running program, whatever PATH
/// says.
std::string program_folder();

}  // namespace sprung
