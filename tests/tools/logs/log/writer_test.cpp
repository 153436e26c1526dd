#include "tools/logs/log/writer.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <lcm/lcm-cpp.hpp>

#include "tests/tools/logs/log/log_sample.h"

namespace sprung::log {
namespace {

class LogWriter : public testing::Test {
 protected:
  LogFolder folder_;
  std::string path_ = folder_("log.lcm");
};

TEST_F(LogWriter, AFileIsBeingWrittenUntilItsWriterHasClosedItOrDied) {
  EXPECT_FALSE(is_being_written(path_));
  const pid_t child = fork();
  if (child == 0) {
    Writer writer(path_);
    writer.write(1, "A", "x", 1);
    writer.flush();
    pause();
    _exit(1);
  }
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!is_being_written(path_) && std::chrono::steady_clock::now() < until) usleep(1000);
  EXPECT_TRUE(is_being_written(path_));
  EXPECT_TRUE(is_being_written(path_)) << "looking at it must not take the lock away";
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(is_being_written(path_));
  Writer own(path_);
  EXPECT_TRUE(is_being_written(path_));
  own.close();
  EXPECT_FALSE(is_being_written(path_));
}

TEST_F(LogWriter, WritesTheBytesThatLcmWrites) {
  const std::vector<Kept> events = sample_events(300);
  const std::string theirs = folder_("theirs.lcm");
  {
    lcm::LogFile log(theirs, "w");
    for (const Kept& kept : events) {
      lcm::LogEvent event{};
      event.timestamp = kept.time_us;
      event.channel = kept.channel;
      event.datalen = static_cast<std::int32_t>(kept.data.size());
      event.data = const_cast<char*>(kept.data.data());
      ASSERT_EQ(log.writeEvent(&event), 0);
    }
  }
  write_all(path_, events);
  EXPECT_EQ(bytes_of(path_), bytes_of(theirs));
  EXPECT_GT(bytes_of(path_).size(), 100'000u);
}

TEST_F(LogWriter, LcmReadsThemBack) {
  const std::vector<Kept> events = sample_events(300);
  write_all(path_, events);
  lcm::LogFile log(path_, "r");
  for (const Kept& kept : events) {
    const lcm::LogEvent* event = log.readNextEvent();
    ASSERT_NE(event, nullptr);
    EXPECT_EQ(event->eventnum, kept.number);
    EXPECT_EQ(event->timestamp, kept.time_us);
    EXPECT_EQ(event->channel, kept.channel);
    EXPECT_EQ(std::string(static_cast<const char*>(event->data), static_cast<std::size_t>(event->datalen)),
              kept.data);
  }
  EXPECT_EQ(log.readNextEvent(), nullptr);
}

TEST_F(LogWriter, CountsEventsAndBytesWhetherWrittenOrNot) {
  Writer writer(path_, 64);
  EXPECT_EQ(writer.bytes(), 0u);
  for (int i = 0; i < 10; ++i) {
    writer.write(i, "ABC", "12345", 5);
    EXPECT_EQ(writer.bytes(), static_cast<std::uint64_t>(i + 1) * (kHeaderBytes + 8));
  }
  EXPECT_EQ(writer.events(), 10);
  EXPECT_LT(bytes_of(path_).size(), writer.bytes());
  writer.flush();
  EXPECT_EQ(bytes_of(path_).size(), writer.bytes());
  writer.sync();
  writer.close();
  writer.close();
  EXPECT_EQ(read_all(path_).size(), 10u);
}

TEST_F(LogWriter, WhoForgetsToCloseLosesNothing) {
  { Writer(path_).write(7, "A", nullptr, 0); }
  const std::vector<Kept> events = read_all(path_);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0], (Kept{0, 7, "A", ""}));
}

TEST_F(LogWriter, AFolderThatIsNotThereIsNamed) {
  try {
    Writer writer("/nowhere/at/all.lcm");
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_FALSE(error.disk_full);
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all.lcm: No such file"), std::string::npos);
  }
}

TEST_F(LogWriter, AFullDiskIsReportedAndTheEventNotTaken) {
  Writer writer("/dev/full", 100);
  writer.write(1, "A", std::string(80, 'x').data(), 80);
  try {
    writer.write(2, "B", "y", 1);
    FAIL();
  } catch (const WriteError& error) {
    EXPECT_TRUE(error.disk_full);
    EXPECT_NE(std::string(error.what()).find("make room"), std::string::npos);
  }
  EXPECT_EQ(writer.events(), 1);
  EXPECT_THROW(writer.flush(), WriteError);
  EXPECT_THROW(writer.close(), WriteError);
}

TEST_F(LogWriter, WhatTheFormatCannotHoldIsRefused) {
  Writer writer(path_);
  EXPECT_THROW(writer.write(1, "", "x", 1), std::invalid_argument);
  EXPECT_THROW(writer.write(1, std::string(1000, 'C'), "x", 1), std::invalid_argument);
  EXPECT_THROW(writer.write(1, "A", "x", std::size_t{1} << 31), std::invalid_argument);
  writer.write(1, std::string(999, 'C'), "x", 1);
  writer.close();
  EXPECT_EQ(read_all(path_).size(), 1u);
}

}  // namespace
}  // namespace sprung::log
