#include "tools/logs/log/reader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <lcm/lcm-cpp.hpp>
#include <random>
#include <stdexcept>

#include "tests/tools/logs/log/log_sample.h"
#include "tools/logs/log/big_endian.h"

namespace sprung::log {
namespace {

class LogReader : public testing::Test {
 protected:
  /// The events 0..count-1 in a file.
  std::string sample(int count) {
    events_ = sample_events(count);
    write_all(path_, events_);
    offsets_ = offsets_of(events_);
    return bytes_of(path_);
  }
  std::vector<Kept> without(std::size_t from, std::size_t count) const {
    std::vector<Kept> left = events_;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(from),
               left.begin() + static_cast<std::ptrdiff_t>(from + count));
    return left;
  }

  LogFolder folder_;
  std::string path_ = folder_("log.lcm");
  std::vector<Kept> events_;
  std::vector<std::size_t> offsets_;
};

TEST_F(LogReader, ReadsWhatLcmItselfWrote) {
  lcm::LogFile log(path_, "w");
  ASSERT_TRUE(log.good());
  for (const Kept& kept : sample_events(300)) {
    lcm::LogEvent event{};
    event.timestamp = kept.time_us;
    event.channel = kept.channel;
    event.datalen = static_cast<std::int32_t>(kept.data.size());
    event.data = const_cast<char*>(kept.data.data());
    ASSERT_EQ(log.writeEvent(&event), 0);
  }
  fflush(log.getFilePtr());
  EXPECT_EQ(read_all(path_), sample_events(300));
}

TEST_F(LogReader, ASmallBufferReadsTheSame) {
  sample(200);
  for (std::size_t bytes : {1u, 57u, 64u, 100u, 999u, 4096u}) {
    ReaderOptions options;
    options.buffer_bytes = bytes;
    Reader reader(path_, options);
    EXPECT_EQ(read_all(reader), events_) << bytes;
    EXPECT_EQ(reader.damage_count(), 0u) << bytes;
    EXPECT_EQ(reader.position(), offsets_.back()) << bytes;
  }
}

TEST_F(LogReader, OffsetsAreThoseOfTheFile) {
  sample(50);
  ReaderOptions options;
  options.buffer_bytes = 128;
  Reader reader(path_, options);
  Event event;
  for (std::size_t i = 0; i < 50; ++i) {
    ASSERT_TRUE(reader.next(event));
    EXPECT_EQ(event.offset, offsets_[i]);
    EXPECT_EQ(event.bytes_in_file(), offsets_[i + 1] - offsets_[i]);
  }
}

TEST_F(LogReader, AnEmptyFileIsALogWithoutEvents) {
  put_bytes(path_, "");
  Reader reader(path_);
  Event event;
  EXPECT_FALSE(reader.next(event));
  EXPECT_EQ(reader.damage_count(), 0u);
}

TEST_F(LogReader, AFileThatIsNotThereIsNamed) {
  try {
    Reader reader("/nowhere/at/all.lcm");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.lcm: No such file"), std::string::npos);
  }
  Event event;
  Reader folder(folder_.path.string());
  EXPECT_THROW(folder.next(event), std::runtime_error);
}

TEST_F(LogReader, AFileThatIsNoLogIsAllDamage) {
  put_bytes(path_, std::string(100'000, 'x'));
  Reader reader(path_);
  EXPECT_TRUE(read_all(reader).empty());
  EXPECT_EQ(reader.skipped_bytes(), 100'000u);
  EXPECT_EQ(reader.damage_count(), 1u);
}

TEST_F(LogReader, ALogThatEndsInsideAnEventGivesAllThatAreWhole) {
  const std::string bytes = sample(20);
  for (std::size_t cut = offsets_[18] + 1; cut < offsets_[19]; cut += 3) {
    put_bytes(path_, bytes.substr(0, cut));
    Reader reader(path_);
    EXPECT_EQ(read_all(reader), without(18, 2)) << cut;
    ASSERT_EQ(reader.damages().size(), 1u) << cut;
    EXPECT_EQ(reader.damages()[0].kind, DamageKind::kCutOff) << cut;
    EXPECT_EQ(reader.damages()[0].offset, offsets_[18]) << cut;
    EXPECT_EQ(reader.skipped_bytes(), cut - offsets_[18]) << cut;
  }
}

TEST_F(LogReader, GarbageCostsTheEventBeforeIt) {
  const std::string bytes = sample(20);
  put_bytes(path_, "#!" + bytes.substr(0, offsets_[7]) + std::string(5000, '\0') + bytes.substr(offsets_[7]));
  Reader reader(path_);
  EXPECT_EQ(read_all(reader), without(6, 1));
  ASSERT_EQ(reader.damages().size(), 2u);
  EXPECT_EQ(reader.damages()[0].offset, 0u);
  EXPECT_EQ(reader.damages()[0].bytes, 2u);
  EXPECT_EQ(reader.damages()[1].offset, 2 + offsets_[6]);
  EXPECT_EQ(reader.damages()[1].bytes, 5000 + offsets_[7] - offsets_[6]);
  EXPECT_EQ(reader.damages()[1].kind, DamageKind::kGarbage);
}

/// As a disk or a crash leaves it: the event whose tail is zero has a whole header, and must not be taken for
/// good.
TEST_F(LogReader, ABlockOfZerosTakesNothingWithIt) {
  std::string bytes = sample(40);
  bytes.replace(offsets_[20] + 50, 4096, 4096, '\0');
  put_bytes(path_, bytes);
  const auto end = std::upper_bound(offsets_.begin(), offsets_.end(), offsets_[20] + 50 + 4096) -
                   offsets_.begin();
  EXPECT_EQ(read_all(path_), without(20, static_cast<std::size_t>(end) - 20));
}

TEST_F(LogReader, ADamagedLengthCostsThatEvent) {
  const std::string bytes = sample(20);
  const std::size_t data_length = offsets_[9] + 24;
  for (const char* length :
       {"\x00\x00\x02\x00", "\x00\x00\x10\x00", "\x7F\xFF\xFF\xFF", "\xFF\xFF\xFF\xFF"}) {
    std::string damaged = bytes;
    damaged.replace(data_length, 4, std::string(length, 4));
    put_bytes(path_, damaged);
    Reader reader(path_);
    EXPECT_EQ(read_all(reader), without(9, 1));
    EXPECT_EQ(reader.skipped_bytes(), offsets_[10] - offsets_[9]);
  }
}

TEST_F(LogReader, ADamagedSyncWordOrChannelLengthCostsThatEventAndAtMostTheOneBefore) {
  const std::string bytes = sample(20);
  for (std::size_t at : {std::size_t{0}, std::size_t{20}}) {
    std::string damaged = bytes;
    damaged[offsets_[9] + at] = '\x55';
    put_bytes(path_, damaged);
    Reader reader(path_);
    const std::size_t first = at == 0 ? 8 : 9;
    EXPECT_EQ(read_all(reader), without(first, 10 - first)) << at;
    EXPECT_EQ(reader.skipped_bytes(), offsets_[10] - offsets_[first]) << at;
  }
}

TEST_F(LogReader, LostBytesCostTheEventsThatTheyWereIn) {
  const std::string bytes = sample(30);
  std::string damaged = bytes;
  damaged.erase(offsets_[11] + 40, offsets_[13] + 30 - (offsets_[11] + 40));
  put_bytes(path_, damaged);
  Reader reader(path_);
  const std::vector<Kept> events = read_all(reader);
  ASSERT_EQ(events.size(), 27u);
  EXPECT_EQ(events, without(11, 3));
}

TEST_F(LogReader, ASyncWordInsideDataIsData) {
  const std::string sync = "\xED\xA1\xDA\x01";
  std::vector<Kept> events{{0, 5, "A", sync + sync + std::string(40, 'x')}, {1, 6, sync, sync}};
  write_all(path_, events);
  EXPECT_EQ(read_all(path_), events);
}

TEST_F(LogReader, TimesMayGoBack) {
  std::vector<Kept> events{{0, 50, "A", "1"}, {1, 40, "A", "2"}, {2, -7, "B", ""}};
  write_all(path_, events);
  EXPECT_EQ(read_all(path_), events);
}

TEST_F(LogReader, AnEventLargerThanAllowedIsDamage) {
  std::vector<Kept> events{{0, 1, "A", "1"}, {1, 2, "BIG", std::string(5000, 'b')}, {2, 3, "C", "3"}};
  write_all(path_, events);
  ReaderOptions options;
  options.largest_event = 4999;
  options.buffer_bytes = 1000;
  Reader small(path_, options);
  EXPECT_EQ(read_all(small).size(), 2u);
  EXPECT_EQ(small.skipped_bytes(), kHeaderBytes + 3 + 5000);
  options.largest_event = 5000;
  Reader enough(path_, options);
  EXPECT_EQ(read_all(enough), events);
}

TEST_F(LogReader, RewindBeginsAgain) {
  const std::string bytes = sample(10);
  put_bytes(path_, "rest" + bytes);
  Reader reader(path_);
  EXPECT_EQ(read_all(reader), events_);
  reader.rewind();
  EXPECT_EQ(reader.damage_count(), 0u);
  EXPECT_EQ(read_all(reader), events_);
  EXPECT_EQ(reader.damage_count(), 1u);
  EXPECT_EQ(reader.skipped_bytes(), 4u);
}

/// Whatever happens to the bytes: no crash, no event made up, and every byte is either in an event or
/// skipped.
TEST_F(LogReader, RandomDamageLosesNoMoreThanItTouches) {
  const std::string bytes = sample(60);
  std::mt19937 random(7);
  for (int round = 0; round < 400; ++round) {
    std::string damaged = bytes;
    const int hits = 1 + static_cast<int>(random() % 4);
    for (int hit = 0; hit < hits; ++hit) damaged[random() % damaged.size()] = static_cast<char>(random());
    put_bytes(path_, damaged);
    ReaderOptions options;
    options.buffer_bytes = 256;
    Reader reader(path_, options);
    std::uint64_t delivered = 0;
    int whole = 0;
    for (Event event; reader.next(event);) {
      delivered += event.bytes_in_file();
      whole += event.number >= 0 && event.number < 60 &&
               keep(event) == events_[static_cast<std::size_t>(event.number)];
    }
    EXPECT_EQ(delivered + reader.skipped_bytes(), bytes.size()) << round;
    // A hit spoils its own event; in a sync word also the one before.
    EXPECT_GE(whole, 60 - 2 * hits) << round;
  }
}

/// Took minutes where each header had all that was read ahead moved.
TEST(Reader, HeadersThatAllClaimALongEventAreReadInOneGo) {
  const LogFolder folder;
  const std::string path = folder("claims.lcm");
  constexpr std::uint32_t kClaimed_bytes = 4 << 20;
  std::string header(kHeaderBytes, '\0');
  auto* const bytes = reinterpret_cast<std::uint8_t*>(header.data());
  put_big_endian(kSyncWord, bytes);
  put_big_endian(std::uint32_t{1}, bytes + 20);
  put_big_endian(kClaimed_bytes, bytes + 24);
  std::string all;
  for (int i = 0; i < 300'000; ++i) all += header;
  put_bytes(path, all);
  ReaderOptions options;
  options.buffer_bytes = 1 << 16;
  Reader reader(path, options);
  EXPECT_TRUE(read_all(reader).empty());
  EXPECT_EQ(reader.skipped_bytes(), all.size());
}

}  // namespace
}  // namespace sprung::log
