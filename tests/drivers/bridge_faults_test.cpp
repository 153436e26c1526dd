// Everything that a bus or a node can do to the bridge: its reaction, its name and its counter.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "drivers/can/can_errors.h"
#include "drivers/canopen/objects.h"
#include "tests/support/bridge_fixture.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
using namespace canopen;

constexpr std::uint32_t kHipSample = 0x181;

class BridgeFaults : public testing::PoweredBridge {
 protected:
  const BusHealth& bus() const { return bench_.bridge->bus_state().buses[0]; }
  void expect_damping(SafetyCause expected, const char* text) {
    EXPECT_EQ(level(), SafetyLevel::kDamping);
    EXPECT_EQ(cause(), expected);
    EXPECT_TRUE(latched());
    EXPECT_THAT(bench_.detail(), HasSubstr(text));
    bench_.run(205);
    EXPECT_EQ(level(), SafetyLevel::kQuickStop);
  }
  void expect_bus_lost(const char* text) {
    EXPECT_EQ(level(), SafetyLevel::kQuickStop);
    EXPECT_EQ(cause(), SafetyCause::kBusLost);
    EXPECT_TRUE(latched());
    EXPECT_THAT(bench_.detail(), HasSubstr(text));
  }
  void expect_cleared() {
    bench_.on_answers = nullptr;
    bench_.run(900);
    EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
    bench_.enable();
    EXPECT_EQ(enabled(), 2);
  }
  /// Calls `change` for every sample of the hip.
  template <class Change>
  void bend_samples(Change change) {
    bench_.on_answers = [change](std::vector<CanFrame>& frames) {
      for (std::size_t i = 0; i < frames.size(); ++i) {
        if (frames[i].id == kHipSample) change(frames, i);
      }
    };
  }
  void controller_error(std::uint8_t detail) {
    CanFrame frame;
    frame.error = true;
    frame.length = 8;
    frame.id = kCanErrorController;
    frame.data[1] = detail;
    bench_.bridge->receive(0, frame, bench_.time_us);
  }
};

TEST_F(BridgeFaults, HealthyRobotCountsFramesAndNothingElse) {
  bench_.run(1100);
  EXPECT_EQ(bus().condition, BusCondition::kActive);
  EXPECT_GT(bus().sent, 3000);
  EXPECT_GT(bus().received, 2000);
  EXPECT_EQ(bus().unexpected + bus().error_frames + bus().bus_offs, 0);
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeHealth& node = health(i);
    EXPECT_EQ(node.missing_samples + node.late_samples + node.short_frames + node.duplicate_samples, 0);
    EXPECT_EQ(node.heartbeat_losses + node.boot_ups + node.emergencies + node.sdo_failures +
                  node.implausible_samples,
              0);
    EXPECT_EQ(node.nmt_state, 5);
    EXPECT_TRUE(node.operational);
    EXPECT_EQ(node.node, static_cast<int>(i) + 1);
    EXPECT_EQ(node.actuator, static_cast<int>(i));
  }
}

TEST_F(BridgeFaults, LoadIsTheWorstCaseOfAllFrames) {
  bench_.run(2100);
  // A cycle: SYNC, two samples of 8 bytes, two set-points of 7; heartbeats every 5 ms; control words at 10 Hz.
  const double bits_per_cycle = 55 + 2 * 135 + 2 * 125 + 3 * 65 / 5.0 + 2 * 75 / 100.0;
  EXPECT_NEAR(bus().load_share, bits_per_cycle * 1000 / 1e6, 0.005);
}

TEST_F(BridgeFaults, BusOffLosesTheBusAndComesBack) {
  bench_.bridge->receive(0, bus_lost_frame(), bench_.time_us);
  bench_.tick();
  expect_bus_lost("it is off");
  EXPECT_EQ(bus().bus_offs, 1);
  EXPECT_EQ(bus().error_frames, 1);
  expect_cleared();
}

TEST_F(BridgeFaults, BusOffOfOneBusStopsTheOthersToo) {
  RobotConfig robot = testing::two_drive_robot();
  robot.buses.push_back({"spare", "memory:spare"});
  testing::BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.bridge->receive(1, bus_lost_frame(), bench.time_us);
  bench.tick();
  EXPECT_EQ(bench.drives[0].power, PowerState::kQuickStopActive);
  EXPECT_THAT(bench.detail(), HasSubstr("bus spare"));
  EXPECT_EQ(bench.bridge->bus_state().buses[1].condition, BusCondition::kOff);
  EXPECT_EQ(bench.bridge->bus_state().buses[0].condition, BusCondition::kActive);
}

TEST_F(BridgeFaults, ErrorPassiveLosesTheBusUntilTheControllerIsActiveAgain) {
  controller_error(0x10);
  bench_.tick();
  expect_bus_lost("it is error passive");
  EXPECT_EQ(bus().condition, BusCondition::kPassive);
  bench_.run(700);
  EXPECT_THAT(bench_.ask(OperatorKind::kClear).reason, HasSubstr("error passive"));
  controller_error(0x40);
  EXPECT_EQ(bus().condition, BusCondition::kActive);
  expect_cleared();
}

TEST_F(BridgeFaults, ErrorPassiveWithoutNewErrorsForbidsClear) {
  controller_error(0x20);
  bench_.run(1500);
  EXPECT_EQ(bus().condition, BusCondition::kPassive);
  EXPECT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kRefused);
}

TEST_F(BridgeFaults, ControlWordsOfACycleThatDidNotGoOutAreSentAgain) {
  bench_.tick();
  ASSERT_TRUE(bench_.sent(canopen::rpdo_id(1, 1)).empty());
  bench_.bridge->send_failed(0, SendFailure::kNoBuffers, bench_.time_us);
  bench_.tick();
  EXPECT_EQ(bench_.sent(canopen::rpdo_id(1, 1)).size(), 1U);
  bench_.tick();
  EXPECT_TRUE(bench_.sent(canopen::rpdo_id(1, 1)).empty());
}

TEST_F(BridgeFaults, ErrorWarningIsShownAndStopsNobody) {
  controller_error(0x08);
  bench_.run(5);
  EXPECT_EQ(bus().condition, BusCondition::kWarning);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeFaults, FullSendQueueIsTroubleOnlyWhenItLasts) {
  for (int cycles = 0; cycles < 2; ++cycles) {
    bench_.bridge->send_failed(0, SendFailure::kNoBuffers, bench_.time_us);
    bench_.tick();
    EXPECT_EQ(bus().condition, BusCondition::kNoBuffers);
    EXPECT_EQ(level(), SafetyLevel::kOperational);
  }
  bench_.bridge->send_failed(0, SendFailure::kNoBuffers, bench_.time_us);
  bench_.tick();
  expect_bus_lost("send queue full");
  bench_.run(2);
  EXPECT_EQ(bus().condition, BusCondition::kActive);
  expect_cleared();
}

TEST_F(BridgeFaults, SingleFullQueuesAreNoTrouble) {
  for (int i = 0; i < 20; ++i) {
    if (i % 3 != 0) bench_.bridge->send_failed(0, SendFailure::kNoBuffers, bench_.time_us);
    bench_.tick();
    ASSERT_EQ(level(), SafetyLevel::kOperational);
  }
}

TEST_F(BridgeFaults, LinkDownLosesTheBusAtOnce) {
  bench_.bridge->send_failed(0, SendFailure::kLinkDown, bench_.time_us);
  EXPECT_EQ(bus().condition, BusCondition::kLinkDown);
  bench_.tick();
  expect_bus_lost("link down");
  for (int i = 0; i < 700; ++i) {
    bench_.bridge->send_failed(0, SendFailure::kLinkDown, bench_.time_us);
    bench_.tick();
  }
  EXPECT_THAT(bench_.ask(OperatorKind::kClear).reason, HasSubstr("ip link set INTERFACE up"));
  expect_cleared();
}

TEST_F(BridgeFaults, ReceiveQueueThatOverflowedIsCounted) {
  bench_.bridge->set_traffic(0, {7, 3, 12, 1});
  EXPECT_EQ(bus().send_failed, 7);
  EXPECT_EQ(bus().no_buffers, 3);
  EXPECT_EQ(bus().dropped, 12);
  EXPECT_EQ(bus().malformed, 1);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeFaults, FramesOfStrangersAreCountedAndIgnored) {
  const std::int64_t before = bus().received;
  for (const std::uint32_t id : {0x183U, 0x705U, 0x000U, 0x201U, 0x381U, 0x77FU}) {
    CanFrame frame;
    frame.id = id;
    frame.length = 8;
    bench_.bridge->receive(0, frame, bench_.time_us);
  }
  EXPECT_EQ(bus().unexpected, 6);
  EXPECT_EQ(bus().received, before + 6);
  bench_.run(3);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeFaults, SamplesThatAreTooShortCountAsMissing) {
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) { frames[i].length = 7; });
  bench_.run(2);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  bench_.tick();
  EXPECT_EQ(health(0).short_frames, 3);
  EXPECT_EQ(health(0).missing_samples, 3);
  expect_damping(SafetyCause::kDriveSilent, "hip_motor: did not answer SYNC for 3 cycles");
  expect_cleared();
}

TEST_F(BridgeFaults, DriveThatGotAShortSetpointSaysSoAndStopsTheRobot) {
  bench_.drives[0].pending_emergency = 0x8210;
  bench_.tick();
  EXPECT_EQ(health(0).emergencies, 1);
  EXPECT_EQ(health(0).last_emergency_code, 0x8210);
  EXPECT_EQ(health(0).error_register, 1);
  expect_damping(SafetyCause::kDriveFault, "hip_motor: drive fault 0x8210");
  expect_cleared();
}

TEST_F(BridgeFaults, EmergencyOfEveryClassIsADriveFaultWithItsText) {
  for (const int code : {0x1000, 0x2310, 0x3210, 0x4210, 0x5113, 0x6320, 0x7320, 0x8611, 0xFF0B}) {
    SCOPED_TRACE(code);
    bench_.drives[0].pending_emergency = static_cast<std::uint16_t>(code);
    bench_.tick();
    EXPECT_THAT(bench_.detail(), HasSubstr(emergency_text(static_cast<std::uint16_t>(code))));
    expect_damping(SafetyCause::kDriveFault, "hip_motor: drive fault 0x");
    expect_cleared();
  }
}

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
  bench_.run(3);
  EXPECT_GE(health(0).late_samples, 3);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
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

TEST_F(BridgeFaults, AnswerThatIsOwedDoesNotReplaceOneInTime) {
  bench_.drives[0].mute_samples = true;
  bench_.tick();
  bench_.drives[0].mute_samples = false;
  const double position_rad = bench_.state.actuators[0].measured_position_rad;
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) {
    if (i > 0 && frames[i - 1].id == kHipSample) return;
    CanFrame other = frames[i];
    other.data[0] ^= 0x55;
    frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i) + 1, other);
  });
  bench_.tick();
  EXPECT_EQ(health(0).late_samples, 1);
  EXPECT_EQ(bench_.state.actuators[0].measured_position_rad, position_rad);
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
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) {
    if (i > 0 && frames[i - 1].id == kHipSample) return;
    CanFrame other = frames[i];
    other.data[0] = static_cast<std::uint8_t>(~other.data[0]);
    frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i) + 1, other);
  });
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
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) {
    if (i > 0 && frames[i - 1].id == kHipSample) return;
    CanFrame other = frames[i];
    other.data[0] = static_cast<std::uint8_t>(~other.data[0]);
    frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i) + 1, other);
  });
  bench_.run(10);
  EXPECT_EQ(cause(), SafetyCause::kDuplicateNode);
}

TEST_F(BridgeFaults, OneFlippedHeartbeatIsNoTrouble) {
  bench_.run(30);
  bench_.bridge->receive(0, heartbeat_frame(1, NmtState::kStopped), bench_.time_us);
  bench_.run(50);
  EXPECT_EQ(level(), SafetyLevel::kOperational) << bench_.detail();
}

TEST_F(BridgeFaults, DriveThatRestartsInMidRunIsNamedAndConfiguredAgain) {
  bench_.drives[1].restart_now = true;
  bench_.run(2);
  EXPECT_EQ(health(1).boot_ups, 1);
  EXPECT_FALSE(health(1).operational);
  expect_damping(SafetyCause::kDriveSilent, "knee_motor: no longer operational: it has restarted");
  expect_cleared();
  EXPECT_THAT(recovery(1), HasSubstr("configured again"));
}

TEST_F(BridgeFaults, HeartbeatThatStopsIsCountedOnce) {
  bench_.drives[0].mute_heartbeat = true;
  bench_.run(120);
  EXPECT_EQ(health(0).heartbeat_losses, 1);
  expect_damping(SafetyCause::kDriveSilent, "hip_motor: no heartbeat");
  bench_.drives[0].mute_heartbeat = false;
  expect_cleared();
}

TEST_F(BridgeFaults, FramesOnTheHeartbeatIdentifierThatAreNoneKeepNobodyAlive) {
  bench_.drives[0].mute_heartbeat = true;
  for (int i = 0; i < 500; ++i) {
    if (i % 20 == 0) bench_.bridge->receive(0, canopen::guard_request(1), bench_.time_us);
    bench_.tick();
  }
  EXPECT_EQ(health(0).heartbeat_losses, 1);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
}

TEST_F(BridgeFaults, DriveThatHasRestartedGetsNoSetpointsUntilItIsConfigured) {
  bench_.command_all(DriveMode::kTorque, 5.0);
  bench_.tick();
  ASSERT_EQ(bench_.sent(canopen::rpdo_id(0, 1)).size(), 1U);
  bench_.drives[0].restart_now = true;
  bench_.run(2);
  EXPECT_TRUE(bench_.sent(canopen::rpdo_id(0, 1)).empty());
  EXPECT_TRUE(bench_.sent(canopen::rpdo_id(1, 1)).empty());
  EXPECT_EQ(bench_.sent(canopen::rpdo_id(0, 2)).size(), 1U);
  expect_cleared();
}

TEST_F(BridgeFaults, SecondDeviceThatRestartsDoesNotTakeTheControlWordFromTheFirst) {
  bench_.bridge->receive(0, canopen::heartbeat_frame(1, canopen::NmtState::kBootUp), bench_.time_us);
  bench_.run(5);
  EXPECT_EQ(cause(), SafetyCause::kDuplicateNode);
  EXPECT_EQ(bench_.sent(canopen::rpdo_id(0, 1)).size(), 1U) << "it is damped, and then stopped";
}

TEST_F(BridgeFaults, FlippedPositionIsKeptOutOfTheStateAndOfTheDamping) {
  bench_.drives[0].position_counts = 5000;
  bench_.run(200);
  const double before_rad = bench_.state.actuators[0].measured_position_rad;
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) { frames[i].data[2] ^= 0x80; });
  bench_.tick();
  EXPECT_EQ(bench_.state.actuators[0].measured_position_rad, before_rad);
  EXPECT_EQ(health(0).implausible_samples, 1);
  EXPECT_EQ(bench_.drives[0].target_torque_permille, 0);
  bench_.on_answers = nullptr;
  expect_damping(SafetyCause::kImplausible, "hip_motor: measured position jumped");
  expect_cleared();
}

TEST_F(BridgeFaults, EncoderThatHasJumpedLosesTheReferenceAlsoAnAbsoluteOne) {
  bench_.drives[0].position_counts += 500'000;
  bench_.run(900);
  EXPECT_EQ(cause(), SafetyCause::kImplausible);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_STREQ(health(0).recovery.data(), "nothing to do; reference lost: encoder jumped");
  EXPECT_STREQ(health(1).recovery.data(), "nothing to do");
  bench_.enable();
  EXPECT_FALSE(bench_.state.actuators[0].referenced);
  EXPECT_NE(bench_.drives[0].power, PowerState::kOperationEnabled);
  EXPECT_EQ(bench_.drives[1].power, PowerState::kOperationEnabled);
  EXPECT_THAT(bench_.detail(), HasSubstr("hip_motor is not referenced"));
}

TEST_F(BridgeFaults, EncoderThatHasJumpedWhileItsDriveWasConfiguredLosesTheReferenceToo) {
  bench_.bridge->receive(0, canopen::emergency_frame(1, {0x8120, 0x11}), bench_.time_us);
  bench_.run(900);
  ASSERT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  bench_.run(60);
  bench_.drives[0].position_counts += 500'000'000;  // 240 rad: more than it can turn in a second
  OperatorReply reply;
  for (int i = 0; i < 7000 && !bench_.bridge->next_reply(reply); ++i) bench_.tick();
  EXPECT_FALSE(bench_.state.actuators[0].referenced);
  EXPECT_TRUE(bench_.state.actuators[1].referenced);
}

/// A robot with incremental encoders, found by jig, whose hip `strike` hits while a clear configures it.
void expect_reference_lost_while_configured(void (*strike)(testing::FakeDrive& hip)) {
  RobotConfig robot = testing::two_drive_robot();
  for (ActuatorConfig& actuator : robot.actuators) {
    actuator.referenced = false;
    actuator.reference = {ReferenceMethod::kJig, false, 1.0, 0.02};
  }
  testing::BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.run(50);
  OperatorCommand home;
  home.kind = OperatorKind::kHome;
  home.request_id = 991;
  home.actuator = -1;
  ASSERT_NE(bench.bridge->operator_command(home, bench.time_us).outcome, OperatorOutcome::kRefused);
  bench.run(20);
  OperatorReply reply;
  while (bench.bridge->next_reply(reply)) {
  }
  ASSERT_TRUE(bench.state.actuators[0].referenced);
  bench.bridge->receive(0, canopen::emergency_frame(1, {0x8120, 0x11}), bench.time_us);
  bench.run(900);
  ASSERT_EQ(bench.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  bench.run(5);
  strike(bench.drives[0]);
  for (int i = 0; i < 7000 && !bench.bridge->next_reply(reply); ++i) {
    bench.tick();
    if (i == 700) bench.drives[0].dead = false;
  }
  EXPECT_EQ(reply.outcome, OperatorOutcome::kDone);
  EXPECT_FALSE(bench.state.actuators[0].referenced);
  EXPECT_THAT(bench.bridge->bus_state().nodes[0].recovery.data(), HasSubstr("reference lost"));
}

TEST(BridgeReferences, IncrementalOneIsLostWhenTheDriveRestartsWhileItIsConfigured) {
  expect_reference_lost_while_configured([](testing::FakeDrive& hip) { hip.restart_now = true; });
}

TEST(BridgeReferences, IncrementalOneIsLostWhenTheBootNeedsASecondTry) {
  expect_reference_lost_while_configured([](testing::FakeDrive& hip) { hip.dead = true; });
}

TEST(BridgeReferences, IncrementalOneIsKeptByAResetOfTheCommunication) {
  RobotConfig robot = testing::two_drive_robot();
  for (ActuatorConfig& actuator : robot.actuators) actuator.reference.absolute_encoder = false;
  testing::BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.run(50);
  bench.bridge->receive(0, canopen::emergency_frame(1, {0x8120, 0x11}), bench.time_us);
  bench.run(900);
  EXPECT_EQ(bench.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(bench.drives[0].resets, 2);
  EXPECT_TRUE(bench.state.actuators[0].referenced);
}

TEST_F(BridgeFaults, LostModeDisplayIsReadBySdo) {
  bench_.drives[0].mute_mode_display = true;
  bench_.command_all(DriveMode::kPosition, 0.0, 0.1);
  bench_.run(40);
  EXPECT_EQ(bench_.state.actuators[0].shown_mode, DriveMode::kTorque) << "not confirmed";
  bench_.run(40);
  EXPECT_EQ(bench_.state.actuators[0].shown_mode, DriveMode::kPosition);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
}

TEST_F(BridgeFaults, DriveThatNeverConfirmsItsModeStopsTheRobotAfterASecond) {
  bench_.drives[0].keeps_mode = true;
  bench_.command_all(DriveMode::kPosition, 0.0, 0.1);
  bench_.run(990);
  EXPECT_EQ(level(), SafetyLevel::kOperational);
  bench_.run(20);
  expect_damping(SafetyCause::kDriveFault,
                 "hip_motor: shows mode 10, a second after it was told to switch to position");
  bench_.drives[0].keeps_mode = false;
  bench_.command_all(DriveMode::kDisabled);
  expect_cleared();
}

}  // namespace
}  // namespace sprung
