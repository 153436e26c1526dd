/// sprung spy --gui: LCM's own lcm-spy with our types and plug-in, on an X server without a screen.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "tests/support/paths.h"
#include "tests/tools/logs/spy/network_sender.h"
#include "tests/tools/logs/spy/run_command.h"
#include "tools/operate/launcher/child_process.h"

namespace sprung {
namespace {

using testing::HasSubstr;

bool has(const std::string& program) { return test::run_command("command -v " + program).status == 0; }

/// Its number, or nothing where it does not start.
class VirtualScreen {
 public:
  VirtualScreen()
      : server_(system_program("Xvfb", "xvfb"),
                {"-displayfd", "1", "-screen", "0", "1100x900x24", "-nolisten", "tcp"}, Output::kCaptured) {}
  ~VirtualScreen() { server_.stop(5.0); }
  std::string name() {
    for (int i = 0; i < 100 && number().empty(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      said_ += server_.output();
    }
    return ":" + number();
  }

 private:
  /// The first line that is one: without root the server complains first.
  std::string number() const {
    std::istringstream in(said_);
    for (std::string line; std::getline(in, line) && !in.eof();)
      if (!line.empty() && line.find_first_not_of("0123456789") == std::string::npos) return line;
    return "";
  }

  ChildProcess server_;
  std::string said_;
};

class SpyGui : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(test::bin_dir() + "/sprung_lcm_spy.jar") || !has("java"))
      GTEST_SKIP() << "no Java, or no lcm.jar when this was built: apt-get install default-jdk liblcm-java "
                      "libjchart2d-java";
  }
  /// Pixels of exactly each colour on the screen.
  static std::vector<long> pixels(const std::string& display, const std::vector<std::uint32_t>& colours) {
    const std::string
        rgb = test::run_command("import -silent -display " + display + " -window root -depth 8 rgb:-").output;
    std::vector<long> counts(colours.size(), 0);
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
      std::uint32_t here = 0;
      for (std::size_t k = 0; k < 3; ++k) here = (here << 8U) | static_cast<std::uint8_t>(rgb[i + k]);
      for (std::size_t c = 0; c < colours.size(); ++c) counts[c] += here == colours[c] ? 1 : 0;
    }
    return counts;
  }
  test::NetworkSender sender_;
};

TEST_F(SpyGui, ShowsTorquesAndPhases) {
  if (!has("Xvfb") || !has("import"))
    GTEST_SKIP() << "no X server for tests: apt-get install xvfb imagemagick";
  VirtualScreen screen;
  const std::string display = screen.name();
  setenv("DISPLAY", display.c_str(), 1);
  ChildProcess gui(test::bin_dir() + "/sprung", {"spy", "JOINT_STATE", "--gui", "--url", sender_.url()});
  // Colours of MotionPanel.java: the lines of both joints, and the strip in crouch and thrust.
  const std::vector<std::uint32_t> wanted{0x1B6CA8, 0xD1495B, 0xFDBF6F, 0xE31A1C};
  std::vector<long> found(wanted.size(), 0);
  for (int i = 0; i < 60 && *std::min_element(found.begin(), found.end()) < 20; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    found = pixels(display, wanted);
  }
  for (std::size_t c = 0; c < wanted.size(); ++c) EXPECT_GE(found[c], 20) << std::hex << wanted[c];
  EXPECT_FALSE(gui.ended().has_value());
  if (const char* keep = std::getenv("SPRUNG_KEEP_PICTURE"))
    test::run_command("import -display " + display + " -window root " + keep);
  gui.stop(5.0);
}

TEST_F(SpyGui, WithoutADisplaySaysSo) {
  unsetenv("DISPLAY");
  const auto end = test::run_sprung("spy --gui --url '" + sender_.url() + "'");
  EXPECT_EQ(end.status, 1);
  EXPECT_TRUE(end.output.find("DISPLAY") != std::string::npos ||
              end.output.find("headless") != std::string::npos)
      << end.output;
}

TEST_F(SpyGui, WithoutItsLibrariesSaysWhatToInstall) {
  const auto end = test::run_command("SPRUNG_JAVA_LIBRARIES=/nowhere " + test::bin_dir() +
                                     "/sprung spy --gui");
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.output, HasSubstr("liblcm-java"));
}

}  // namespace
}  // namespace sprung
