#include "tools/logs/recorder/recording.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "lcmtypes/channels.h"
#include "runtime/receive_guard.h"
#include "sprung_msgs/imu_t.hpp"
#include "tests/support/own_folder.h"
#include "tools/logs/log/reader.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kStart_us = 1'700'000'000'000'000;

class RecordingTest : public testing::Test {
 protected:
  RecordingTest() : folder_(fs::path(test::temp_dir()) / ("recording-" + test_name())) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    options_.path = (folder_ / "x.lcm").string();
    metadata_.session = 7;
    metadata_.utc_us = kStart_us;
    metadata_.utime = 5'000'000;
    metadata_.robot = "single_leg";
  }
  ~RecordingTest() override { fs::remove_all(folder_); }

  static std::string test_name() { return testing::UnitTest::GetInstance()->current_test_info()->name(); }

  Recording recording() {
    return Recording(options_, metadata_, [this](const std::string&) { return free_bytes_; });
  }
  static void add(Recording& recording, std::int64_t seq, const char* channel = channels::kImu) {
    sprung_msgs::imu_t message{};
    message.seq = seq;
    const auto bytes = message_bytes(message);
    recording.add(kStart_us + 1000 * seq, channel, bytes.data(), bytes.size());
  }
  struct Read {
    std::vector<std::string> channels;
    std::vector<std::int64_t> seqs;  ///< of IMU
    std::optional<sprung_msgs::log_metadata_t> metadata;
    std::optional<sprung_msgs::log_end_t> end;
    std::uint64_t damages = 0;
  };
  static Read read(const std::string& path) {
    Read out;
    log::Reader reader(path);
    for (log::Event event; reader.next(event);) {
      out.channels.emplace_back(event.channel);
      if (event.channel == channels::kImu) out.seqs.push_back(read_int64(event.data, kSeqOffset));
      if (event.channel == channels::kLogMetadata) out.metadata = read_log_metadata(event.data, event.size);
      if (event.channel == channels::kLogEnd) out.end = read_log_end(event.data, event.size);
    }
    out.damages = reader.damage_count();
    return out;
  }

  fs::path folder_;
  RecordingOptions options_;
  sprung_msgs::log_metadata_t metadata_{};
  std::uint64_t free_bytes_ = 1'000'000'000;
};

TEST_F(RecordingTest, BeginsWithMetadataAndEndsWithItsEnd) {
  Recording recording = this->recording();
  add(recording, 0);
  add(recording, 1);
  recording.end(kStart_us + 10'000, LogEndReason::kAsked, "ended in order");
  const Read log = read(options_.path);
  EXPECT_EQ(log.channels, (std::vector<std::string>{"LOG_METADATA", "IMU", "IMU", "LOG_END"}));
  ASSERT_TRUE(log.metadata && log.end);
  EXPECT_EQ(log.metadata->robot, "single_leg");
  EXPECT_EQ(log.metadata->part, 0);
  EXPECT_EQ(log.end->events, 3);
  EXPECT_EQ(log.end->missing, 0);
  EXPECT_EQ(log.end->session, 7);
  EXPECT_EQ(log.end->utime, 5'010'000);
  EXPECT_EQ(log.end->reason, static_cast<std::int8_t>(LogEndReason::kAsked));
}

TEST_F(RecordingTest, MetadataIsOnTheDiskAtOnce) {
  Recording recording = this->recording();
  EXPECT_EQ(read(options_.path).channels, std::vector<std::string>{"LOG_METADATA"});
}

TEST_F(RecordingTest, TickHandsOverWhatWasGathered) {
  Recording recording = this->recording();
  add(recording, 0);
  recording.tick(kStart_us);
  EXPECT_EQ(read(options_.path).seqs, std::vector<std::int64_t>{0});
}

TEST_F(RecordingTest, NothingIsAddedAfterTheEnd) {
  Recording recording = this->recording();
  recording.end(kStart_us, LogEndReason::kAsked, "");
  add(recording, 0);
  recording.tick(kStart_us);
  recording.end(kStart_us, LogEndReason::kWriteError, "again");
  EXPECT_EQ(recording.ended(), LogEndReason::kAsked);
  EXPECT_EQ(read(options_.path).channels.size(), 2u);
}

TEST_F(RecordingTest, SplitBySizeLosesNothingAndEveryPartStandsAlone) {
  options_.split_bytes = 2000;
  Recording recording = this->recording();
  for (int k = 0; k < 100; ++k) add(recording, k);
  recording.end(kStart_us + 1'000'000, LogEndReason::kAsked, "");
  ASSERT_GT(recording.files().size(), 3u);
  std::vector<std::int64_t> seqs;
  for (std::size_t part = 0; part < recording.files().size(); ++part) {
    const Read log = read(recording.files()[part]);
    ASSERT_TRUE(log.metadata && log.end);
    EXPECT_EQ(log.metadata->part, static_cast<std::int32_t>(part));
    EXPECT_EQ(log.channels.front(), "LOG_METADATA");
    EXPECT_EQ(log.channels.back(), "LOG_END");
    const bool last = part + 1 == recording.files().size();
    EXPECT_EQ(static_cast<LogEndReason>(log.end->reason),
              last ? LogEndReason::kAsked : LogEndReason::kContinued);
    if (!last) {
      EXPECT_NE(log.end->detail.find(recording.files()[part + 1]), std::string::npos);
    }
    seqs.insert(seqs.end(), log.seqs.begin(), log.seqs.end());
  }
  ASSERT_EQ(seqs.size(), 100u);
  for (int k = 0; k < 100; ++k) EXPECT_EQ(seqs[k], k);
  EXPECT_EQ(recording.missing(), 0);
  std::uint64_t bytes = 0;
  for (const std::string& file : recording.files()) bytes += fs::file_size(file);
  EXPECT_EQ(recording.bytes(), bytes);
}

TEST_F(RecordingTest, SplitByTime) {
  options_.split_us = 30'000;
  Recording recording = this->recording();
  for (int k = 0; k < 100; ++k) add(recording, k);
  recording.end(kStart_us + 1'000'000, LogEndReason::kAsked, "");
  ASSERT_EQ(recording.files().size(), 4u);
  EXPECT_EQ(read(recording.files()[0]).seqs.back(), 30);
  EXPECT_EQ(read(recording.files()[1]).seqs.front(), 31);
}

TEST_F(RecordingTest, PartsSortByName) {
  EXPECT_EQ(part_path({"logs/x.lcm", 1, 0, 0}, 7), "logs/x-007.lcm");
  EXPECT_EQ(part_path({"x.lcm", 0, 1, 0}, 0), "x-000.lcm");
  EXPECT_EQ(part_path({"logs/x.lcm", 0, 0, 0}, 0), "logs/x.lcm");
}

TEST_F(RecordingTest, EndsInOrderBeforeTheDiskIsFull) {
  options_.least_free_bytes = 100'000'000;
  Recording recording = this->recording();
  add(recording, 0);
  recording.tick(kStart_us + 1000);
  EXPECT_FALSE(recording.ended());
  free_bytes_ = 99'000'000;
  recording.tick(kStart_us + 2000);
  EXPECT_EQ(recording.ended(), LogEndReason::kDiskGuard);
  EXPECT_NE(recording.detail().find("less than 100 MB"), std::string::npos);
  const Read log = read(options_.path);
  ASSERT_TRUE(log.end);
  EXPECT_EQ(static_cast<LogEndReason>(log.end->reason), LogEndReason::kDiskGuard);
  EXPECT_EQ(log.end->detail, recording.detail());
}

/// A burst must not outrun the guard between two ticks.
TEST_F(RecordingTest, LooksAtTheDiskAsItWritesToo) {
  options_.least_free_bytes = 100'000'000;
  Recording recording = this->recording();
  free_bytes_ = 0;
  const std::vector<std::uint8_t> big(100'000);
  for (int i = 0; i < 30 && !recording.ended(); ++i) recording.add(kStart_us, "BIG", big.data(), big.size());
  EXPECT_EQ(recording.ended(), LogEndReason::kDiskGuard);
  EXPECT_LT(fs::file_size(options_.path), 1'500'000u);
}

TEST_F(RecordingTest, DoesNotBeginOnADiskThatIsFullAndTouchesNoFile) {
  options_.least_free_bytes = 100'000'000;
  free_bytes_ = 1'000'000;
  EXPECT_THROW(recording(), std::runtime_error);
  EXPECT_FALSE(fs::exists(options_.path));
  std::ofstream(options_.path) << "an earlier log";
  EXPECT_THROW(recording(), std::runtime_error);
  EXPECT_EQ(fs::file_size(options_.path), 14u);
}

TEST_F(RecordingTest, FileThatIsThereIsKeptWhereThatIsAsked) {
  options_.keep_existing = true;
  std::ofstream(options_.path) << "an earlier log";
  EXPECT_THROW(recording(), std::runtime_error);
  EXPECT_EQ(fs::file_size(options_.path), 14u);
  fs::resize_file(options_.path, 0);  // made beforehand, e.g. by mktemp
  Recording recording = this->recording();
  EXPECT_EQ(read(options_.path).channels, std::vector<std::string>{"LOG_METADATA"});
}

TEST_F(RecordingTest, FirstPartThatIsThereIsKeptToo) {
  options_.keep_existing = true;
  options_.split_bytes = 1000;
  std::ofstream(part_path(options_, 0)) << "an earlier log";
  EXPECT_THROW(recording(), std::runtime_error);
}

TEST_F(RecordingTest, GoesOnWhereItsFileIsMovedAway) {
  options_.least_free_bytes = 1;
  Recording recording(options_, metadata_);  // asks the disk itself
  fs::rename(folder_, folder_.string() + "-moved");
  add(recording, 0);
  recording.tick(kStart_us + 1000);
  EXPECT_FALSE(recording.ended());
  recording.end(kStart_us + 2000, LogEndReason::kAsked, "");
  EXPECT_EQ(read(folder_.string() + "-moved/x.lcm").seqs, std::vector<std::int64_t>{0});
  fs::remove_all(folder_.string() + "-moved");
}

TEST_F(RecordingTest, DiskThatTakesNoMoreEndsItWithTheCause) {
  options_.path = "/dev/full";
  EXPECT_THROW(recording(), log::WriteError);
}

TEST_F(RecordingTest, FileThatCannotBeMadeIsNamed) {
  options_.path = "/nowhere/x.lcm";
  try {
    (void)recording();
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/x.lcm"), std::string::npos);
  }
}

TEST_F(RecordingTest, GapsAreCountedByChannelAndSaidOnce) {
  Recording recording = this->recording();
  for (const int k : {0, 1, 4, 5}) add(recording, k);
  for (const int k : {0, 7}) add(recording, k, channels::kSafetyState);
  EXPECT_EQ(recording.missing(), 2);
  EXPECT_EQ(recording.take_news(), "cycles missing: IMU 2");
  EXPECT_EQ(recording.take_news(), "");
  recording.end(kStart_us, LogEndReason::kAsked, "");
  EXPECT_EQ(read(options_.path).end->missing, 2);
}

TEST_F(RecordingTest, InRealTimeAGapIsNoAlarm) {
  metadata_.clock = "realtime";
  Recording recording = this->recording();
  for (const int k : {0, 2}) add(recording, k);
  EXPECT_EQ(recording.take_news(), "cycles missing: IMU 1 (in real time, who comes late skips them)");
}

TEST_F(RecordingTest, ForeignMessagesAreRecordedAndNotTakenForCycles) {
  Recording recording = this->recording();
  const std::uint8_t bytes[] = {1, 2, 3};
  recording.add(kStart_us, channels::kImu, bytes, sizeof bytes);  // too short for a cycle
  recording.add(kStart_us, "FOREIGN", bytes, sizeof bytes);
  EXPECT_EQ(recording.events(), 2);
  EXPECT_EQ(recording.missing(), 0);
}

TEST(FreeDiskBytes, IsKnownWhereTheFolderIs) {
  EXPECT_GT(free_disk_bytes("/"), 0u);
  EXPECT_GT(free_disk_bytes("/no-such-file"), 0u);
  EXPECT_THROW((void)free_disk_bytes("/nowhere/at/all"), std::runtime_error);
}

}  // namespace
}  // namespace sprung
