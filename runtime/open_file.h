#pragma once
#include <unistd.h>

namespace sprung {

/// A descriptor that is closed with it; negative: there is none.
struct OpenFile {
  explicit OpenFile(int number) : fd(number) {}
  ~OpenFile() {
    if (fd >= 0) close(fd);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  int fd;
};

}  // namespace sprung
