#include "tools/station/video/log_video.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "tests/support/refusal.h"
#include "tests/tools/logs/log/robot_sample.h"
#include "tools/operate/launcher/child_process.h"
#include "tools/station/video/offscreen_gl.h"

namespace sprung::station {
namespace {

using testing::HasSubstr;

/// Why nothing may be drawn in this program, "" = it may.
std::string undrawable() {
#ifdef __SANITIZE_ADDRESS__
  return "Mesa's drivers lose memory of their own, which the sanitizer would name";
#else
  return "";
#endif
}

/// What this machine lacks for a video, "" = nothing.
std::string missing() {
  if (const std::string why = undrawable(); !why.empty()) return why;
  try {
    system_program("ffmpeg", "ffmpeg", OfSetup::kNo);
    make_offscreen_gl(64, 64);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

class LogVideoTest : public testing::Test {
 protected:
  /// Of cycles of 2 ms.
  std::string log_of(std::int64_t cycles) {
    std::vector<log::Kept> events = log::robot_events(cycles);
    events.front() = log::metadata_event(log::robot_yaml("single_leg"));
    log::write_all(log_, events);
    return log_;
  }
  std::string refusal(const VideoOptions& options = {320, 240}) {
    return test::refusal_of<std::runtime_error>([&] {
      log::Reader reader(log_);
      write_video(reader, folder_("v.mp4"), options);
    });
  }
  log::LogFolder folder_;
  std::string log_ = folder_("jump.lcm");
};

TEST_F(LogVideoTest, HasThirtyPicturesASecondOfTheRobotsTimeAndMoreWhereItIsSlow) {
  if (const std::string what = missing(); !what.empty()) GTEST_SKIP() << what;
  log::Reader reader(log_of(100));  // 0.198 s from the first to the last
  EXPECT_EQ(write_video(reader, folder_("v.mp4"), {320, 240, 30, 1.0}).pictures, 6u);
  reader.rewind();
  EXPECT_EQ(write_video(reader, folder_("slow.mp4"), {320, 240, 30, 0.5}).pictures, 12u);
  std::ifstream in(folder_("v.mp4"), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(bytes.substr(4, 4), "ftyp");
}

TEST_F(LogVideoTest, WithoutFfmpegSaysWhatToInstall) {
  log_of(10);
  const std::string path = std::getenv("PATH");
  setenv("PATH", folder_.path.c_str(), 1);
  const std::string said = refusal();
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(said, HasSubstr("apt-get install ffmpeg"));
  EXPECT_THAT(said, Not(HasSubstr("./setup"))) << "which does not install it";
}

TEST_F(LogVideoTest, AnFfmpegThatFailsIsNoVideo) {
  if (const std::string why = undrawable(); !why.empty()) GTEST_SKIP() << why;
  log_of(10);
  const std::string fake = folder_("ffmpeg");
  std::ofstream(fake) << "#!/bin/sh\nexit 1\n";
  std::filesystem::permissions(fake, std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  setenv("PATH", (folder_.path.string() + ":" + path).c_str(), 1);
  const std::string said = refusal();
  setenv("PATH", path.c_str(), 1);
  EXPECT_THAT(said, testing::AnyOf(HasSubstr("v.mp4"), HasSubstr("OpenGL without a screen")));
}

TEST_F(LogVideoTest, OfJointStatesOfAnotherVersionIsRefused) {
  std::vector<log::Kept> events{log::metadata_event(log::robot_yaml("single_leg"))};
  for (int cycle = 0; cycle < 20; ++cycle) {
    events.push_back(log::command_event(cycle, cycle));
    events.push_back(log::joint_event(cycle));
    events.back().data[0] ^= 0x55;
  }
  log::write_all(log_, events);
  EXPECT_THAT(refusal(), HasSubstr("JOINT_STATE is of another version of its message"));
}

TEST_F(LogVideoTest, OfALogWithoutARobotIsRefused) {
  log::write_all(log_, {log::joint_event(0)});
  EXPECT_THAT(refusal(), HasSubstr("jump.lcm cannot be drawn"));
}

}  // namespace
}  // namespace sprung::station
