#pragma once
/// A serial line in software: what this end writes the other end reads.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sprung::test {

class Pty {
 public:
  Pty() : fd_(::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC)) {
    EXPECT_EQ(::grantpt(fd_), 0);
    EXPECT_EQ(::unlockpt(fd_), 0);
    char name[64] = "";
    EXPECT_EQ(::ptsname_r(fd_, name, sizeof name), 0);
    name_ = name;
  }
  ~Pty() { ::close(fd_); }
  Pty(const Pty&) = delete;
  Pty& operator=(const Pty&) = delete;

  const std::string& name() const { return name_; }
  void write(const std::vector<std::uint8_t>& bytes) {
    EXPECT_EQ(::write(fd_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }

 private:
  int fd_;
  std::string name_;
};

}  // namespace sprung::test
