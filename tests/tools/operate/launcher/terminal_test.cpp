#include "tools/operate/launcher/terminal.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
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
    for (int i = 0; i < 2 && saved_[0] >= 0; ++i) dup2(saved_[i], i);
    for (const int fd : saved_) {
      if (fd >= 0) close(fd);
    }
    saved_ = {-1, -1};
  }
  /// All until `end` has come; the kernel hands it over in its own time.
  std::string shown_until(const std::string& end) const {
    std::string all;
    std::array<char, 4096> text{};
    while (all.find(end) == std::string::npos) {
      pollfd wait{master_, POLLIN, 0};
      if (poll(&wait, 1, 5000) != 1) break;
      const ssize_t got = read(master_, text.data(), text.size());
      if (got <= 0) break;
      all.append(text.data(), static_cast<std::size_t>(got));
    }
    return all;
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
  const std::string bytes = shown_until("\x1b[?1049l");
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

TEST_F(PseudoTerminal, OnlyCtrlCStillMeansSomething) {
  termios before{}, during{}, after{};
  tcgetattr(0, &before);
  {
    const Terminal terminal;
    tcgetattr(0, &during);
  }
  tcgetattr(0, &after);
  give_back();
  EXPECT_EQ(during.c_cc[VSUSP], _POSIX_VDISABLE);
  EXPECT_EQ(during.c_cc[VQUIT], _POSIX_VDISABLE);
  EXPECT_EQ(during.c_cc[VINTR], before.c_cc[VINTR]);
  EXPECT_EQ(during.c_iflag & IXON, 0u);
  EXPECT_NE(during.c_lflag & ISIG, 0u);
  EXPECT_EQ(after.c_cc[VSUSP], before.c_cc[VSUSP]);
  EXPECT_EQ(after.c_iflag, before.c_iflag);
}

/// Exit status of what a child does; 128 + signal where it had to be ended.
template <class Act>
int status_of(Act act) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(10);
    _exit(act());
  }
  int raw = 0;
  waitpid(child, &raw, WUNTRACED);
  if (!WIFSTOPPED(raw)) return WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  return 128 + SIGSTOP;
}

/// As `sprung up ... &` does.
TEST_F(PseudoTerminal, InTheBackgroundOfItsShellThereIsNoScreen) {
  const std::string name = ptsname(master_);
  const auto has_screen = [&name](bool in_background) {
    return status_of([&] {
      setsid();  // a shell with a terminal of its own
      const int terminal = open(name.c_str(), O_RDWR);
      if (terminal < 0 || ioctl(terminal, TIOCSCTTY, 0) != 0) return 9;
      return status_of([&] {
        if (in_background) setpgid(0, 0);
        return has_terminal() ? 1 : 0;
      });
    });
  };
  const int in_front = has_screen(false), behind = has_screen(true);
  give_back();
  EXPECT_EQ(in_front, 1);
  EXPECT_EQ(behind, 0);
}

TEST_F(PseudoTerminal, TerminalThatTakesNothingHoldsNobodyUp) {
  const int status = status_of([] {
    Terminal terminal;
    const std::vector<ScreenLine> lines(30, ScreenLine{std::string(100, 'x'), LineStyle::kPlain});
    for (int i = 0; i < 50; ++i) terminal.draw(lines);  // 150 kB, which nobody reads
    return 0;
  });
  give_back();
  EXPECT_EQ(status, 0);
}

TEST_F(PseudoTerminal, DumbTerminalGetsPlainLines) {
  setenv("TERM", "dumb", 1);
  const bool there = has_terminal();
  give_back();
  EXPECT_FALSE(there);
}

}  // namespace
}  // namespace sprung
