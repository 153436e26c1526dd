#include "tools/logs/log/rewrite.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

class LogRewrite : public testing::Test {
 protected:
  std::vector<Kept> part(const std::string& from, const std::string& to,
                         const std::vector<std::string>& keep = {},
                         const std::vector<std::string>& drop = {}) {
    Reader reader(in_);
    Writer writer(out_);
    ChannelFilter filter(keep, drop);
    result_ = copy_part(reader, parse_span(from, to), filter, writer);
    return read_all(out_);
  }
  /// Without numbers, which are the new file's.
  static std::vector<Kept> same(std::vector<Kept> events) {
    for (std::size_t i = 0; i < events.size(); ++i) events[i].number = static_cast<std::int64_t>(i);
    return events;
  }

  LogFolder folder_;
  std::string in_ = folder_("in.lcm"), out_ = folder_("out.lcm");
  RewriteResult result_;
};

TEST_F(LogRewrite, ACutHasTheStretchAndTheMetadata) {
  write_all(in_, robot_events(300));
  const std::vector<Kept> got = part("0.1", "0.2");
  std::vector<Kept> wanted{metadata_event()};
  for (const Kept& event : robot_events(300)) {
    const std::int64_t since_us = event.time_us - kSampleBegin_us - 300;
    if (since_us >= 100'000 && since_us < 200'000) wanted.push_back(event);
  }
  wanted[0].time_us = wanted[1].time_us;  // a cut of 0.1 s lasts 0.1 s for tools that go by events' times
  EXPECT_EQ(got, same(wanted));
  EXPECT_EQ(result_.read, 1 + 600 + 3 + 1);
  EXPECT_EQ(result_.written, 1 + 100);
  EXPECT_EQ(result_.bytes, bytes_of(out_).size());
}

TEST_F(LogRewrite, ACutFromTheEndAndByTheClock) {
  write_all(in_, robot_events(300));
  EXPECT_EQ(part("-0.1", "").size(), part("0.5", "").size());  // the log's end is LOG_END's 0.6 s
  EXPECT_EQ(part("@1700000000.5003", ""), part("0.5", ""));
}

TEST_F(LogRewrite, ChannelsAreChosen) {
  write_all(in_, robot_events(10));
  const std::vector<Kept> got = part("", "", {"*_STATE"}, {"JOINT_*"});
  ASSERT_EQ(got.size(), 1u + 10u + 1u);
  EXPECT_EQ(got[0].channel, "LOG_METADATA");
  for (std::size_t i = 1; i < got.size(); ++i)
    EXPECT_TRUE(got[i].channel == "MOTION_STATE" || got[i].channel == "SAFETY_STATE");
}

TEST_F(LogRewrite, MetadataThatNobodyAskedForIsToldApart) {
  write_all(in_, robot_events(10));
  EXPECT_EQ(part("5", "").size(), 1u);
  EXPECT_EQ(result_.brought, 1);
  EXPECT_EQ(result_.written, 1) << "nothing else";
  part("", "", {"LOG_METADATA"});
  EXPECT_EQ(result_.brought, 0);
  EXPECT_EQ(result_.written, 1);
}

TEST_F(LogRewrite, LogEndDoesNotComeAlong) {
  write_all(in_, robot_events(10));
  for (const Kept& event : part("", "")) EXPECT_NE(event.channel, "LOG_END");
}

TEST_F(LogRewrite, MergedLogsAreInTheOrderOfTheirTimes) {
  std::vector<Kept> a, b;
  for (int k = 0; k < 20; ++k) (k % 3 == 0 ? a : b).push_back(joint_event(k));
  const std::string third = folder_("empty.lcm");
  write_all(in_, a);
  write_all(folder_("b.lcm"), b);
  write_all(third, {});
  Writer writer(out_);
  const RewriteResult result = merge({in_, third, folder_("b.lcm")}, writer);
  EXPECT_EQ(result.written, 20);
  std::vector<Kept> wanted;
  for (int k = 0; k < 20; ++k) wanted.push_back(joint_event(k));
  EXPECT_EQ(read_all(out_), same(wanted));
}

TEST_F(LogRewrite, EventsOfOneLogStayInOrderAndEqualTimesKeepTheLogsOrder) {
  write_all(in_, {{0, 50, "A", "1"}, {0, 40, "A", "2"}, {0, 60, "A", "3"}});
  write_all(folder_("b.lcm"), {{0, 45, "B", "4"}, {0, 60, "B", "5"}});
  Writer writer(out_);
  merge({in_, folder_("b.lcm")}, writer);
  std::string order;
  for (const Kept& event : read_all(out_)) order += event.data;
  EXPECT_EQ(order, "41235");
}

TEST_F(LogRewrite, RepairSavesWhatIsWholeAndCanBeDecoded) {
  std::vector<Kept> events = robot_events(20);
  const std::vector<std::size_t> offsets = offsets_of(events);
  Kept spoiled = joint_event(99);
  spoiled.data.resize(spoiled.data.size() - 3);
  events.push_back(spoiled);
  write_all(in_, events);
  std::string bytes = bytes_of(in_);
  bytes[offsets[7]] = '?';  // a sync word: that event and the one before are lost
  put_bytes(in_, bytes);
  Reader reader(in_);
  Writer writer(out_);
  const RewriteResult result = repair(reader, writer);
  EXPECT_EQ(result.refused, 1);
  EXPECT_EQ(result.damages, 1u);
  EXPECT_EQ(result.skipped_bytes, offsets[8] - offsets[6]);
  std::vector<Kept> wanted = robot_events(20);
  wanted.pop_back();  // LOG_END
  wanted.erase(wanted.begin() + 6, wanted.begin() + 8);
  EXPECT_EQ(read_all(out_), same(wanted));
}

TEST_F(LogRewrite, RepairKeepsWhatItCannotKnow) {
  const std::vector<Kept> events{{0, 1, "CAMERA", "x"}, {1, 2, "CAMERA", std::string(100, 'x')}};
  write_all(in_, events);
  Reader reader(in_);
  Writer writer(out_);
  EXPECT_EQ(repair(reader, writer).refused, 0);
  EXPECT_EQ(read_all(out_), events);
}

TEST_F(LogRewrite, ALogIsNotWrittenOverItself) {
  write_all(in_, {});
  std::filesystem::create_symlink(in_, out_);
  EXPECT_THROW(refuse_same_file({in_}, in_), std::invalid_argument);
  EXPECT_THROW(refuse_same_file({folder_("b.lcm"), in_}, out_), std::invalid_argument);
  EXPECT_NO_THROW(refuse_same_file({in_}, folder_("new.lcm")));
}

}  // namespace
}  // namespace sprung::log
