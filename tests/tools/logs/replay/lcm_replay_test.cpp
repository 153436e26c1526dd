#include "tools/logs/replay/lcm_replay.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <thread>

#include "lcmtypes/channels.h"
#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tests/runtime/lcm_network.h"
#include "tests/tools/logs/replay/logged_message.h"
#include "tests/tools/logs/replay/logged_run_fixture.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/writer.h"
#include "tools/logs/recorder/network_tap.h"

namespace sprung {
namespace {

using test::Folder;
using test::message_of;

/// A log of ten cycles, 10 ms each: DRIVE_STATE and IMU.
class LcmReplayTest : public testing::Test {
 protected:
  LcmReplayTest() {
    request_.log = folder_ / "x.lcm";
    request_.lcm_url = url_;
    log::Writer writer(request_.log);
    for (std::int64_t k = 0; k < 10; ++k) {
      DriveState state(1);
      Imu imu;
      state.stamp = imu.stamp = {10'000 * k, k};
      for (const auto& [channel, bytes] :
           {std::pair{channels::kDriveState, message_of(state)}, std::pair{channels::kImu, message_of(imu)}})
        writer.write(1'000'000 + 10'000 * k, channel, bytes.data(), bytes.size());
    }
    writer.close();
  }

  struct Heard {
    std::vector<std::string> channels;
    std::vector<std::int64_t> seqs;
  };
  /// What has come, at least so many messages, and whatever came before an end that is sent after them.
  Heard heard(std::size_t least) {
    Heard out;
    lcm::LCM lcm(url_);
    bool ended = false;
    for (const std::int64_t end_us = monotonic_us() + kTimeout_us; !ended && monotonic_us() < end_us;) {
      if (out.seqs.size() >= least) lcm.publish(kEnd, "", 0);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      ended = take(out);
    }
    EXPECT_TRUE(ended) << out.seqs.size() << " of " << least << " messages came";
    return out;
  }
  /// @return whether the end was among it.
  bool take(Heard& out) {
    MessageQueue::Batch batch;
    queue_.take(batch);
    bool ended = false;
    batch.for_each([&](std::int64_t, std::string_view channel, const std::uint8_t* data, std::size_t) {
      ended = ended || channel == kEnd;
      if (channel == kEnd) return;
      out.channels.emplace_back(channel);
      out.seqs.push_back(read_int64(data, kSeqOffset));
    });
    return ended;
  }

  static constexpr const char* kEnd = "END_OF_TEST";
  static constexpr std::int64_t kTimeout_us = 20'000'000;
  const Folder folder_{"lcm-replay"};
  const std::string url_ = test::own_lcm_url();
  LcmReplayRequest request_;
  MessageQueue queue_;
  NetworkTap tap_{url_, ".*", queue_};
};

TEST_F(LcmReplayTest, SendsEveryMessageInItsOrder) {
  request_.speed = 10.0;
  const LcmReplayResult result = replay_to_lcm(request_);
  EXPECT_EQ(result.messages, 20);
  EXPECT_EQ(result.failed, 0);
  EXPECT_EQ(result.laps, 1);
  const Heard heard = this->heard(20);
  ASSERT_EQ(heard.channels.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    EXPECT_EQ(heard.channels[i], i % 2 == 0 ? "DRIVE_STATE" : "IMU");
    EXPECT_EQ(heard.seqs[i], static_cast<std::int64_t>(i / 2));
  }
}

TEST_F(LcmReplayTest, TakesTheTimeThatTheLogTook) {
  const std::int64_t began_us = monotonic_us();
  replay_to_lcm(request_);
  EXPECT_GE(monotonic_us() - began_us, 90'000);
}

TEST_F(LcmReplayTest, PartOfTheLogAndSomeChannels) {
  request_.speed = 0.0;
  request_.start_s = 0.0199;
  request_.duration_s = 0.031;
  request_.channels = {"IM*"};
  EXPECT_EQ(replay_to_lcm(request_).messages, 4);
  EXPECT_EQ(heard(4).seqs, (std::vector<std::int64_t>{2, 3, 4, 5}));
}

TEST_F(LcmReplayTest, ChannelsGetOtherNames) {
  request_.speed = 0.0;
  request_.drop = {"DRIVE_STATE"};
  request_.remaps = {"IMU=IMU_OLD"};
  replay_to_lcm(request_);
  EXPECT_EQ(heard(10).channels, std::vector<std::string>(10, "IMU_OLD"));
}

TEST_F(LcmReplayTest, StepsCycleByCycleAndEndsWhenToldTo) {
  int steps = 0;
  const LcmReplayResult result = replay_to_lcm(request_, [&](double) { return ++steps <= 3; });
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(result.messages, 6);
  EXPECT_EQ(heard(6).seqs, (std::vector<std::int64_t>{0, 0, 1, 1, 2, 2}));
}

TEST_F(LcmReplayTest, StepsByAnotherChannelWhereThatIsNotSent) {
  request_.channels = {"IMU"};
  std::vector<double> times;
  replay_to_lcm(request_, [&](double time_s) {
    times.push_back(time_s);
    return times.size() < 3;
  });
  ASSERT_EQ(times.size(), 3u);
  EXPECT_NEAR(times[1] - times[0], 0.01, 1e-9);
}

TEST_F(LcmReplayTest, StepsByTheCyclesOfALogWithoutDriveState) {
  const std::string old_log = request_.log;
  request_.log = folder_ / "imu.lcm";
  {
    log::Writer writer(request_.log);
    writer.write(1'000'000, channels::kLogMetadata, "m", 1);
    writer.write(1'000'000, "CAMERA", "c", 1);
    log::Reader reader(old_log);
    for (log::Event event; reader.next(event);) {
      if (event.channel == channels::kImu) writer.write(event);
    }
  }
  int steps = 0;
  const LcmReplayResult result = replay_to_lcm(request_, [&](double) { return ++steps <= 3; });
  EXPECT_EQ(steps, 4);
  EXPECT_EQ(result.messages, 2 + 3);
}

TEST_F(LcmReplayTest, RemapOfAChannelThatIsNotSentIsTold) {
  request_.speed = 0.0;
  request_.remaps = {"IMU=IMU_OLD", "IMO=IMU_OLD"};
  EXPECT_EQ(replay_to_lcm(request_).not_renamed, std::vector<std::string>{"IMO"});
}

TEST_F(LcmReplayTest, LoopsUntilAStopIsAskedFor) {
  request_.speed = 0.0;
  request_.loop = true;
  int steps = 0;
  const LcmReplayResult result = replay_to_lcm(request_, [&](double) { return ++steps <= 25; });
  EXPECT_EQ(result.laps, 2);
  EXPECT_EQ(result.messages, 50);
}

/// In the middle of the log, which takes 90 s at this speed.
TEST_F(LcmReplayTest, StopRequestEndsIt) {
  request_.speed = 0.001;
  std::thread stopper([this] {
    EXPECT_GE(heard(2).seqs.size(), 2u);
    request_stop();
  });
  const LcmReplayResult result = replay_to_lcm(request_);
  EXPECT_GE(result.messages, 2);
  EXPECT_LT(result.messages, 20);
  stopper.join();
  clear_stop_request();
}

TEST_F(LcmReplayTest, NothingToSendEndsALoop) {
  request_.loop = true;
  request_.channels = {"NO_SUCH"};
  EXPECT_EQ(replay_to_lcm(request_).messages, 0);
}

TEST_F(LcmReplayTest, WrongPatternsAndAddressesAreRefused) {
  request_.remaps = {"IMU"};
  EXPECT_THROW(replay_to_lcm(request_), std::invalid_argument);
  request_.remaps = {};
  request_.lcm_url = "nonsense://";
  EXPECT_THROW(replay_to_lcm(request_), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
