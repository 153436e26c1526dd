#pragma once
/// What a command writes: a file, or standard output; a full disk ends the command.
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sprung::commands {

class OutputFile {
 public:
  /// @param path "-" = standard output. @throws std::runtime_error where it cannot be made.
  explicit OutputFile(const std::string& path)
      : path_(path), file_(path == "-" ? stdout : std::fopen(path.c_str(), "wb")) {
    if (file_ == nullptr) fail();
  }
  ~OutputFile() {
    if (file_ != nullptr && file_ != stdout) std::fclose(file_);
  }
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail();
  }
  /// @throws std::runtime_error where not all could be written.
  void finish() {
    if (std::fflush(file_) != 0) fail();
  }

 private:
  [[noreturn]] void fail() const {
    const std::string hint = errno == ENOSPC || errno == EDQUOT ? "; make room, or write to another disk"
                                                                : "";
    throw std::runtime_error("cannot write " + (path_ == "-" ? "to standard output" : path_) + ": " +
                             std::strerror(errno) + hint);
  }

  std::string path_;
  FILE* file_;
};

}  // namespace sprung::commands
