// Answers that come late, twice or from a second device of the same node id.
#include <gmock/gmock.h>

#include "drivers/canopen/objects.h"
#include "tests/drivers/bridge/faults_fixture.h"

namespace sprung {
namespace {

using namespace canopen;

TEST_F(BridgeFaults, LateSamplesCountAsMissingAndAsLate) {
  std::vector<CanFrame> held;
  bend_samples([&held](std::vector<CanFrame>& frames, std::size_t i) {
    held.push_back(frames[i]);
    frames[i].id = 0x7FE;
  });
  bench_.run(2);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  bench_.tick();
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
  bench_.bridge->receive(0, held.back(), bench_.time_us);
  EXPECT_EQ(health(0).late_samples, 1);
  EXPECT_EQ(health(0).missing_samples, 3);
}

TEST_F(BridgeFaults, SampleThatCameBeforeThisSyncIsLate) {
  bench_.drives[0].mute_samples = true;
  bench_.on_answers = [this](std::vector<CanFrame>& frames) {
    if (frames.empty()) return;
    CanFrame old = frames.front();
    old.id = kHipSample;
    old.length = 8;
    bench_.bridge->receive(0, old, bench_.time_us - 300);
  };
  bench_.run(4);
  EXPECT_EQ(level(), SafetyLevel::kOperational) << "the newest answer is two cycles old at most";
  bench_.tick();
  EXPECT_GE(health(0).late_samples, 5);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent) << "but none ever comes in its cycle";
  EXPECT_THAT(bench_.detail(), ::testing::HasSubstr("hip_motor: did not answer SYNC in time for 5 cycles"));
}

TEST_F(BridgeFaults, LateSampleInTheNextWindowIsNoSecondDevice) {
  CanFrame held;
  for (int i = 0; i < 40; ++i) {
    bend_samples([&held, i](std::vector<CanFrame>& frames, std::size_t at) {
      if (i % 2 == 0) {
        held = frames[at];
        frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(at));
      } else if (held.id != 0) {
        frames.insert(frames.begin(), held);
        held.id = 0;
      }
    });
    bench_.drives[0].position_counts += 100;
    bench_.tick();
  }
  EXPECT_EQ(level(), SafetyLevel::kOperational) << bench_.detail();
  EXPECT_EQ(health(0).late_samples, 20);
  EXPECT_EQ(health(0).duplicate_samples, 0);
}

TEST_F(BridgeFaults, AnswersThatComeSeveralCyclesLateTogetherAreNoSecondDevice) {
  std::vector<CanFrame> held;
  for (int i = 0; i < 60; ++i) {
    bend_samples([&held, i](std::vector<CanFrame>& frames, std::size_t at) {
      held.push_back(frames[at]);
      frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(at));
      if (i % 3 != 2) return;  // nothing in two cycles, then all three
      frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(at), held.begin(), held.end());
      held.clear();
    });
    bench_.drives[0].position_counts += 100;
    bench_.tick();
    bench_.on_answers = nullptr;
  }
  EXPECT_EQ(level(), SafetyLevel::kOperational) << bench_.detail();
  EXPECT_EQ(health(0).duplicate_samples, 0);
  EXPECT_GT(health(0).late_samples, 20);
}

TEST_F(BridgeFaults, LostAnswersHideASecondDeviceOnlyForAWhile) {
  for (int i = 0; i < 10; ++i) {
    bend_samples([](std::vector<CanFrame>& frames, std::size_t at) {
      frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(at));
    });
    bench_.tick();
    bench_.on_answers = nullptr;
    bench_.run(3);
  }
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) {
    if (i > 0 && frames[i - 1].id == kHipSample) return;
    CanFrame other = frames[i];
    other.data[0] ^= 0x55;
    frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i) + 1, other);
  });
  bench_.run(20);
  EXPECT_EQ(cause(), SafetyCause::kDuplicateNode) << bench_.detail();
}

TEST_F(BridgeFaults, AnswersLostLongAgoNeitherHideASecondDeviceNorLetItsSamplesIn) {
  for (int i = 0; i < 40; ++i) {
    bench_.drives[0].mute_samples = i % 2 == 0;
    bench_.tick();
  }
  bench_.drives[0].mute_samples = false;
  bench_.run(10);
  const double position_rad = bench_.state.actuators[0].measured_position_rad;
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) {
    if (i > 0 && frames[i - 1].id == kHipSample) return;
    CanFrame other = frames[i];
    other.data[0] ^= 0x55;
    frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i) + 1, other);
  });
  for (int i = 0; i < 4; ++i) {
    bench_.tick();
    EXPECT_EQ(bench_.state.actuators[0].measured_position_rad, position_rad);
  }
  EXPECT_EQ(cause(), SafetyCause::kDuplicateNode) << bench_.detail();
}

TEST_F(BridgeFaults, FramesThatTheBusRepeatsDoNothing) {
  bench_.on_answers = [](std::vector<CanFrame>& frames) {
    const std::vector<CanFrame> again = frames;
    frames.insert(frames.end(), again.begin(), again.end());
  };
  bench_.command_all(DriveMode::kTorque, 5.0);
  for (int i = 0; i < 100; ++i) {
    bench_.drives[0].position_counts += 100;
    bench_.tick();
  }
  EXPECT_EQ(level(), SafetyLevel::kOperational) << bench_.detail();
  EXPECT_EQ(health(0).duplicate_samples, 100);
  EXPECT_EQ(bench_.state.actuators[0].age_cycles, 0);
}

TEST_F(BridgeFaults, TwoDifferentAnswersToOneSyncAreTwoDevices) {
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) {
    if (i + 1 < frames.size() && frames[i + 1].id == kHipSample) return;
    if (i > 0 && frames[i - 1].id == kHipSample) return;
    CanFrame other = frames[i];
    other.data[0] ^= 0x55;
    frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i) + 1, other);
  });
  bench_.run(2);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  bench_.run(3);
  expect_damping(SafetyCause::kDuplicateNode, "hip_motor: two devices answer as node 1");
  expect_cleared();
}

TEST_F(BridgeFaults, BootUpOfADriveThatGoesOnAnsweringIsASecondDevice) {
  bench_.bridge->receive(0, heartbeat_frame(1, NmtState::kBootUp), bench_.time_us);
  bench_.run(4);
  expect_damping(SafetyCause::kDuplicateNode, "two devices answer as node 1");
  EXPECT_EQ(health(0).boot_ups, 1);
  expect_cleared();
}

TEST_F(BridgeFaults, HeartbeatsThatContradictTheAnswersAreASecondDevice) {
  bench_.run(30);
  bench_.on_answers = [](std::vector<CanFrame>& frames) {
    for (std::size_t i = 0; i < frames.size(); ++i) {
      if (frames[i] == heartbeat_frame(1, NmtState::kOperational))
        frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                      heartbeat_frame(1, NmtState::kPreOperational));
    }
  };
  bench_.run(15);
  expect_damping(SafetyCause::kDuplicateNode, "two devices answer as node 1");
  expect_cleared();
}

TEST_F(BridgeFaults, SecondDeviceIsNoticedWithinTenCyclesAlsoAfterASilenceThatWasCleared) {
  bench_.drives[0].nmt = NmtState::kPreOperational;
  bench_.drives[0].power = PowerState::kSwitchOnDisabled;
  expect_cleared();
  bend_samples(a_second_device_answers);
  bench_.run(10);
  EXPECT_EQ(cause(), SafetyCause::kDuplicateNode) << "answers from before its reset are not owed";
}

/// One bit turns "operational" into "stopped".
TEST_F(BridgeFaults, HeartbeatsWithAFlippedBitAreNoSecondDevice) {
  int heartbeats = 0;
  bench_.on_answers = [&heartbeats](std::vector<CanFrame>& frames) {
    for (CanFrame& frame : frames) {
      if (frame.id != 0x701) continue;
      const unsigned flipped = 1U << (heartbeats++ % 8);
      frame.data[0] = static_cast<std::uint8_t>(frame.data[0] ^ flipped);
    }
  };
  bench_.run(1000);
  ASSERT_GT(heartbeats, 100);
  EXPECT_EQ(level(), SafetyLevel::kOperational) << bench_.detail();
}

TEST_F(BridgeFaults, StoppedHeartbeatsBesideASecondAnswerAreASecondDevice) {
  bench_.run(30);
  int cycles = 0;
  bench_.on_answers = [&cycles](std::vector<CanFrame>& frames) {
    std::vector<CanFrame> others;
    for (const CanFrame& frame : frames) {
      if (frame.id == 0x701) others.push_back(heartbeat_frame(1, NmtState::kStopped));
      if (frame.id != kHipSample || ++cycles % 6 != 1) continue;
      others.push_back(frame);  // too seldom to tell by itself
      others.back().data[0] ^= 0x55;
    }
    frames.insert(frames.end(), others.begin(), others.end());
  };
  bench_.run(20);
  expect_damping(SafetyCause::kDuplicateNode, "two devices answer as node 1");
  expect_cleared();
}

TEST_F(BridgeFaults, SecondDeviceIsNoticedWithinTenCycles) {
  bend_samples(a_second_device_answers);
  bench_.run(10);
  EXPECT_EQ(cause(), SafetyCause::kDuplicateNode);
}

TEST_F(BridgeFaults, OneFlippedHeartbeatIsNoTrouble) {
  bench_.run(30);
  bench_.bridge->receive(0, heartbeat_frame(1, NmtState::kStopped), bench_.time_us);
  bench_.run(50);
  EXPECT_EQ(level(), SafetyLevel::kOperational) << bench_.detail();
}

}  // namespace
}  // namespace sprung
