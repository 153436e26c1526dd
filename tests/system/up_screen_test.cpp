/// `sprung up` in a terminal: script(1) of bsdutils, which every Debian has, gives it one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "runtime/own_port.h"
#include "tests/support/paths.h"
#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::EndsWith;
using testing::HasSubstr;

class UpScreen : public SystemTest {
 protected:
  std::string shown() const {
    std::ifstream in(folder_ / "terminal.txt");
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }
  bool shows(const std::string& what) const {
    for (int i = 0; i < 3000 && shown().find(what) == std::string::npos; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return shown().find(what) != std::string::npos;
  }
};

TEST_F(UpScreen, ShowsEveryProcessAndGivesTheTerminalBack) {
  const std::string
      command = test::bin_dir() +
                "/sprung up single_leg --sim --clock lockstep --speed 1 --no-record --lcm-url '" + lcm_url() +
                "' --can leg=udp:239.74.163.2:" + std::to_string(own_port());
  ChildProcess script("/usr/bin/env",
                      {"TERM=xterm", "script", "-qfec", "stty cols 140 rows 30; " + command,
                       (folder_ / "terminal.txt").string()},
                      Output::kCaptured);
  EXPECT_TRUE(shows("single_leg is up")) << shown();
  for (const char* part : {"\x1b[?1049h", "cpu %", "age ms", "sprung-can-bridge       running",
                           "sprung-sim-drives", "safety  operational", "ready in", "Ctrl-C ends it"})
    EXPECT_TRUE(shows(part)) << part;
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_TRUE(script.wait(kTimeout_s));
  EXPECT_THAT(shown(), HasSubstr("\x1b[?1049l"));
  EXPECT_EQ(script.ended(), 0);
  if (!script.ended()) script.stop(5.0);
}

}  // namespace
}  // namespace sprung
