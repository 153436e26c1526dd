#pragma once
/// How the key of a run gets from `sprung up` to who may command: by an inherited file descriptor to its
/// processes, by a file of its user alone to that user's commands. Never in a command line, an environment, a
/// log or the run file, which others can read. A key is 32 bytes, as they are, in both.
#include <memory>
#include <string>

#include "runtime/message_key.h"

namespace sprung {

/// Says its number to programs that `sprung run` starts.
inline constexpr const char* kKeyFdVariable = "SPRUNG_KEY_FD";

/// From the kernel's random numbers. @throws std::system_error when there are none.
std::shared_ptr<const MessageKey> random_key();

/// Reads and closes it; others that inherited it can still read theirs. @throws std::runtime_error where it
/// is not open, or does not hold a key.
std::shared_ptr<const MessageKey> read_key_fd(int fd);

/// Of a file that nobody but its owner can read. @throws std::runtime_error naming the file and the remedy
/// where it is not there, a link, another user's, open to others, or no key.
std::shared_ptr<const MessageKey> read_key_file(const std::string& path);

/// For its owner alone, in place of what stands there. @throws std::runtime_error when it cannot be written.
void write_key_file(const std::string& path, const MessageKey& key);

/// A descriptor that children may inherit and read; it has no name, and cannot be changed any more. Closed
/// with this object, and in every program that is started unless inherit() was called there.
class KeyFd {
 public:
  explicit KeyFd(const MessageKey& key);  ///< @throws std::system_error
  ~KeyFd();
  KeyFd(const KeyFd&) = delete;
  KeyFd& operator=(const KeyFd&) = delete;
  int number() const noexcept { return fd_; }
  static void inherit(int fd) noexcept;  ///< between fork and exec, or before exec

 private:
  int fd_;
};

}  // namespace sprung
