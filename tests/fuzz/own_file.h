#pragma once
/// A file of this process for code that reads files; in memory where there is such a folder.
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sprung::fuzz {

/// "FOLDER/sprung-fuzz-PID/", made once; libFuzzer ends without calling destructors, so the next run of this
/// process id takes it over.
inline std::string own_folder() {
  static const std::string folder = [] {
    const std::string base = access("/dev/shm", W_OK) == 0 ? "/dev/shm" : "/tmp";
    const std::string path = base + "/sprung-fuzz-" + std::to_string(getpid());
    if (mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) throw std::runtime_error("cannot make " + path);
    return path + "/";
  }();
  return folder;
}

inline void write_file(const std::string& path, std::string_view bytes) {
  if (!std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
    throw std::runtime_error("cannot write " + path);
}

}  // namespace sprung::fuzz
