#pragma once
/// A file of this process for code that reads files; in memory where there is such a folder.
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sprung::fuzz {

/// "FOLDER/sprung-fuzz-PID/", made once and gone with the process. Where libFuzzer ends it, tests/fuzz/run
/// tidies up.
inline const std::string& own_folder() {
  struct Folder {
    Folder()
        : path((access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp") +
               ("/sprung-fuzz-" + std::to_string(getpid()) + "/")) {
      std::filesystem::create_directories(path);
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::string path;
  };
  static const Folder folder;
  return folder.path;
}

inline void write_file(const std::string& path, std::string_view bytes) {
  if (!std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw std::runtime_error("cannot write " + path);
}

}  // namespace sprung::fuzz
