#pragma once
/// A program that reads lines and writes lines, as a process of its own: what it breaks, it breaks alone.
#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace sprung {

class PipedChild {
 public:
  /// @throws std::runtime_error naming the program where it cannot be started.
  explicit PipedChild(std::vector<std::string> words);
  ~PipedChild();  ///< kills it where it runs
  PipedChild(const PipedChild&) = delete;
  PipedChild& operator=(const PipedChild&) = delete;

  int output() const { return output_; }  ///< to wait for, with poll()
  pid_t pid() const { return pid_; }
  /// @return false where it reads no more.
  bool say(const std::string& line);
  /// Takes what it has written. @return false where it has ended.
  bool read_more();
  std::optional<std::string> line();  ///< the next whole one

  /// Kills it where it runs. @return "killed by signal 9", "exit status 1".
  std::string end();
  std::string wait();  ///< the same of one that ends by itself

 private:
  pid_t pid_ = -1;
  int input_ = -1, output_ = -1;
  std::string text_;
};

}  // namespace sprung
