// `sprung clear` after a bus was lost: facts canopen 5.
#include <gmock/gmock.h>

#include "drivers/bridge/recovery.h"
#include "drivers/can/can_errors.h"
#include "tests/support/bridge_fixture.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
using BridgeBusRecovery = test::PoweredBridge;

CanFrame error_passive_frame() {
  CanFrame frame = bus_lost_frame();
  frame.id = kCanErrorController;
  frame.data[1] = kControllerPassive;
  return frame;
}

CanFrame bus_active_again_frame() {
  CanFrame frame = error_passive_frame();
  frame.data[1] = 0x40;
  return frame;
}

TEST_F(BridgeBusRecovery, BusOffIsRefusedUntilFramesComeAgain) {
  bench_.bridge->receive(0, bus_lost_frame(), bench_.time_us);
  for (auto& drive : bench_.drives) drive.mute_samples = drive.mute_heartbeat = true;
  bench_.tick();
  EXPECT_EQ(level(), SafetyLevel::kQuickStop);
  EXPECT_EQ(cause(), SafetyCause::kBusLost);
  EXPECT_THAT(bench_.detail(), HasSubstr("bus leg (memory:leg) is lost: it is off"));
  EXPECT_THAT(bench_.ask(OperatorKind::kClear).reason, HasSubstr("restart-ms"));
  for (auto& drive : bench_.drives) drive.mute_samples = drive.mute_heartbeat = false;
  bench_.run(900);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
}

TEST_F(BridgeBusRecovery, ControllerThatRestartedMayBeClearedAtOnce) {
  bench_.bridge->receive(0, bus_lost_frame(), bench_.time_us);
  for (auto& drive : bench_.drives) drive.dead = true;
  bench_.run(50);
  CanFrame restarted = bus_lost_frame();
  restarted.id = kCanErrorRestarted;
  bench_.bridge->receive(0, restarted, bench_.time_us);
  for (auto& drive : bench_.drives) {
    drive.dead = false;
    drive.power = PowerState::kSwitchOnDisabled;
  }
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(bench_.bridge->bus_state().buses[0].restarts, 1);
  bench_.enable();
  EXPECT_EQ(enabled(), 2);
}

/// facts canopen 5: its drives have let go and may have restarted unheard, whatever they say now.
TEST_F(BridgeBusRecovery, NodesOfABusThatWasLostAreAllConfiguredAgain) {
  struct Loss {
    CanFrame frame;
    const char* text;
  };
  const Loss losses[] = {{bus_lost_frame(), "bus was off: reset communication, configured again ("},
                         {link_down_frame(), "bus had no link: reset communication, configured again ("},
                         {error_passive_frame(), "bus was passive: reset communication, configured again ("}};
  for (const Loss& loss : losses) {
    SCOPED_TRACE(loss.text);
    const int resets = bench_.drives[0].resets;
    bench_.bridge->receive(0, loss.frame, bench_.time_us);
    bench_.tick();
    ASSERT_EQ(cause(), SafetyCause::kBusLost);
    bench_.run(1200);
    CanFrame active_again = error_passive_frame();
    active_again.data[1] = 0x40;
    bench_.bridge->receive(0, active_again, bench_.time_us);
    ASSERT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_THAT(recovery(i), ::testing::StartsWith(loss.text));
      EXPECT_EQ(bench_.drives[i].resets, resets + 1);
    }
    bench_.enable();
    ASSERT_EQ(enabled(), 2);
  }
  bench_.ask(OperatorKind::kEstop);
  bench_.run(10);
  ASSERT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(recovery(0), "nothing to do") << "once is enough";
}

TEST_F(BridgeBusRecovery, BusThatIsLostWhileAClearIsUnderWayEndsIt) {
  for (const int ticks : {0, 1, 2, 3}) {
    SCOPED_TRACE(ticks);
    bench_.ask(OperatorKind::kEstop);
    bench_.run(10);
    ASSERT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
    OperatorReply reply;
    bench_.run(ticks);
    if (bench_.bridge->next_reply(reply)) return;  // that was after its end
    bench_.bridge->receive(0, error_passive_frame(), bench_.time_us);
    for (int i = 0; i < 10 && !bench_.bridge->next_reply(reply); ++i) bench_.tick();
    EXPECT_EQ(reply.outcome, OperatorOutcome::kFailed);
    EXPECT_THAT(reply.reason, HasSubstr("a bus was lost"));
    EXPECT_TRUE(latched());
    expect_stays_off();
    bench_.bridge->receive(0, bus_active_again_frame(), bench_.time_us);
    ASSERT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
    EXPECT_THAT(recovery(0), ::testing::StartsWith("bus was passive: reset communication"));
  }
}

TEST_F(BridgeBusRecovery, BusThatIsLostAndBackWhileAClearIsUnderWayEndsItToo) {
  bench_.ask(OperatorKind::kEstop);
  bench_.run(10);
  ASSERT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  bench_.bridge->receive(0, error_passive_frame(), bench_.time_us);
  bench_.bridge->receive(0, bus_active_again_frame(), bench_.time_us);
  OperatorReply reply;
  for (int i = 0; i < 10 && !bench_.bridge->next_reply(reply); ++i) bench_.tick();
  EXPECT_EQ(reply.outcome, OperatorOutcome::kFailed) << "its nodes may have let go or restarted unheard";
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
}

TEST_F(BridgeBusRecovery, NodesOfOtherBusesAreLeftAlone) {
  RobotConfig robot = test::two_drive_robot();
  robot.buses.push_back({"spare", "memory:spare"});
  test::BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.enable();
  CanFrame restarted = bus_lost_frame();
  restarted.id = kCanErrorRestarted;
  bench.bridge->receive(1, bus_lost_frame(), bench.time_us);
  bench.bridge->receive(1, restarted, bench.time_us);
  bench.run(900);
  ASSERT_EQ(bench.bridge->safety().cause, SafetyCause::kBusLost);
  ASSERT_EQ(bench.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_STREQ(bench.bridge->bus_state().nodes[0].recovery.data(), "nothing to do");
  EXPECT_EQ(bench.drives[0].resets, 1);
}

TEST_F(BridgeBusRecovery, LossOfTheBusAndTheFaultThatStandsAreBothTold) {
  bench_.bridge->receive(0, bus_lost_frame(), bench_.time_us);
  bench_.drives[0].pending_emergency = 0x8130;
  bench_.run(900);
  ASSERT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone) << bench_.detail();
  EXPECT_THAT(recovery(0),
              ::testing::StartsWith("bus was off, fault 0x8130 life guard or heartbeat lost: reset"));
  EXPECT_THAT(recovery(0), ::testing::EndsWith(" objects), fault reset"));
}

}  // namespace
}  // namespace sprung
