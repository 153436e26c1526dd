#include "tools/launcher/terminal.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>

namespace sprung {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

TEST(Drawing, BeginsInTheCornerAndBlanksWhatIsLeft) {
  const std::string bytes = drawing({{"one", LineStyle::kPlain}, {"two", LineStyle::kPlain}});
  EXPECT_EQ(bytes, "\x1b[Hone\x1b[K\r\ntwo\x1b[K\x1b[J");
}

TEST(Drawing, StyleEndsWithItsLine) {
  EXPECT_EQ(drawing({{"dead", LineStyle::kBad}}), "\x1b[H\x1b[31mdead\x1b[0m\x1b[K\x1b[J");
}

/// Standard input and output are a pseudo terminal as long as this lives.
class PseudoTerminal : public testing::Test {
 protected:
  void SetUp() override {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    ASSERT_GE(master_, 0);
    ASSERT_EQ(grantpt(master_), 0);
    ASSERT_EQ(unlockpt(master_), 0);
    const int slave = open(ptsname(master_), O_RDWR | O_NOCTTY);
    ASSERT_GE(slave, 0);
    const winsize window{30, 100, 0, 0};
    ioctl(slave, TIOCSWINSZ, &window);
    fflush(stdout);
    saved_ = {dup(0), dup(1)};
    dup2(slave, 0);
    dup2(slave, 1);
    close(slave);
    setenv("TERM", "xterm", 1);
  }
  void TearDown() override {
    give_back();
    close(master_);
  }
  /// Before anything is expected: gtest writes to standard output.
  void give_back() {
    for (int i = 0; i < 2 && saved_[0] >= 0; ++i) dup2(saved_[static_cast<std::size_t>(i)], i);
    for (const int fd : saved_) {
      if (fd >= 0) close(fd);
    }
    saved_ = {-1, -1};
  }
  std::string shown() const {
    std::array<char, 4096> text{};
    const ssize_t got = read(master_, text.data(), text.size());
    return got < 0 ? "" : std::string(text.data(), static_cast<std::size_t>(got));
  }
  int master_ = -1;
  std::array<int, 2> saved_{-1, -1};
};

TEST_F(PseudoTerminal, ScreenIsTakenDrawnAndGivenBack) {
  bool there = false;
  Terminal::Size size;
  bool echo_during = true;
  bool echo_after = false;
  {
    there = has_terminal();
    termios settings{};
    {
      Terminal terminal;
      size = terminal.size();
      tcgetattr(0, &settings);
      echo_during = (settings.c_lflag & ECHO) != 0;
      terminal.draw({{"hello", LineStyle::kHeading}});
    }
    tcgetattr(0, &settings);
    echo_after = (settings.c_lflag & ECHO) != 0;
  }
  const std::string bytes = shown();
  give_back();
  EXPECT_TRUE(there);
  EXPECT_EQ(size.width, 100u);
  EXPECT_EQ(size.height, 30u);
  EXPECT_FALSE(echo_during);
  EXPECT_TRUE(echo_after);
  EXPECT_THAT(bytes, StartsWith("\x1b[?1049h"));
  EXPECT_THAT(bytes, HasSubstr("hello"));
  EXPECT_THAT(bytes, EndsWith("\x1b[?1049l"));
}

TEST_F(PseudoTerminal, DumbTerminalGetsPlainLines) {
  setenv("TERM", "dumb", 1);
  const bool there = has_terminal();
  give_back();
  EXPECT_FALSE(there);
}

}  // namespace
}  // namespace sprung
