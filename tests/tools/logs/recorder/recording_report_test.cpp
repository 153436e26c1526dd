#include "tools/logs/recorder/recording_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "lcmtypes/channels.h"
#include "sprung_msgs/imu_t.hpp"
#include "tests/support/own_folder.h"

namespace sprung {
namespace {

using testing::HasSubstr;
using testing::Not;

class RecordingReport : public testing::Test {
 protected:
  ~RecordingReport() override { std::filesystem::remove(path_); }
  void add(std::int64_t seq, const char* channel) {
    sprung_msgs::imu_t message{};
    message.seq = seq;
    const auto bytes = message_bytes(message);
    recording_.add(0, channel, bytes.data(), bytes.size());
  }

  const std::string path_ = test::temp_dir() + "recording_report_test.lcm";
  Recording recording_{{path_, 0, 0, 0}, {}};
};

TEST_F(RecordingReport, NamesFileAndWhatIsInIt) {
  add(0, channels::kImu);
  add(0, channels::kSafetyState);
  recording_.end(0, LogEndReason::kAsked, "");
  const std::string text = recording_report(recording_, 3);
  EXPECT_THAT(text, HasSubstr("recorded " + path_));
  EXPECT_THAT(text, HasSubstr("2 messages on 2 channels"));
  EXPECT_THAT(text, HasSubstr("0 cycles missing, at most 3 messages waited"));
  EXPECT_THAT(text, Not(HasSubstr("IMU")));  // nothing is worth a line
  EXPECT_THAT(text, Not(HasSubstr("ended because")));
}

TEST_F(RecordingReport, SaysWhatIsMissingAndWhere) {
  add(0, channels::kImu);
  add(5, channels::kImu);
  add(9, channels::kImu);
  EXPECT_THAT(
      recording_report(recording_, 0),
      HasSubstr("IMU                7 cycles missing in 2 gaps, 0 came twice, first gap at cycle 1\n"));
}

TEST_F(RecordingReport, SaysWhyItEndedByItself) {
  recording_.end(0, LogEndReason::kDiskGuard, "no room");
  EXPECT_THAT(recording_report(recording_, 0), HasSubstr("ended because the disk was nearly full: no room"));
}

}  // namespace
}  // namespace sprung
