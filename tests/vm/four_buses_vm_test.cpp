/// pegasus on four vcans: the cores of bridge and simulated drives, every frame through the kernel's CAN,
/// tick by tick in message time, so that an emulated CPU need not keep a robot's pace (the real processes run
/// beside this with single_leg: guest-robot). Run by tests/vm/guest-four-buses as root with can0..can3 up and
/// candump listening.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "drivers/bridge/bridge_core.h"
#include "drivers/can/socketcan_bus.h"
#include "robots/robot_loader.h"
#include "simulation/sim_core.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

using Buses = std::vector<std::unique_ptr<SocketCanBus>>;

Buses open_all(std::size_t count) {
  Buses buses;
  for (std::size_t i = 0; i < count; ++i)
    buses.push_back(std::make_unique<SocketCanBus>("can" + std::to_string(i)));
  return buses;
}

/// As many frames as were sent on each bus; fewer when nothing has come for a second.
FrameBatch collect(Buses& buses, const std::vector<int>& counts) {
  FrameBatch all;
  for (std::size_t bus = 0; bus < buses.size(); ++bus) {
    for (int got = 0; got < counts[bus];) {
      CanFrame frame;
      pollfd wait{buses[bus]->fd(), POLLIN, 0};
      if (buses[bus]->receive(&frame, 1) == 1) {
        all.push(static_cast<int>(bus), frame);
        ++got;
      } else if (::poll(&wait, 1, 1000) <= 0) {
        break;
      }
    }
  }
  return all;
}

class FourBuses : public testing::Test {
 protected:
  /// @return frames that each bus took.
  template <class Failed>
  std::vector<int> send(Buses& buses, const FrameBatch& batch, bool logged, Failed failed) {
    std::vector<int> counts(buses.size());
    for (const BusFrame& frame : batch) {
      const auto bus = static_cast<std::size_t>(frame.bus);
      if (buses[bus]->send(&frame.frame, 1)) {
        ++counts[bus];
        if (logged) note(frame);
      } else {
        failed(frame.bus);
      }
    }
    return counts;
  }

  /// Lines as candump's: interface, id#data.
  void note(const BusFrame& frame) {
    char text[40];
    int at = std::snprintf(text, sizeof text, "can%d %03X#", frame.bus, frame.frame.id);
    for (int i = 0; i < frame.frame.length; ++i)
      at += std::snprintf(text + at, sizeof text - static_cast<std::size_t>(at), "%02X", frame.frame.data[i]);
    log_ << text << "\n";
  }

  void tick() {
    time_us_ += cycle_us_;
    bridge_.begin_tick(time_us_, out_);
    const auto failed = [this](int bus) { bridge_.send_failed(bus, SendFailure::kLinkDown, time_us_); };
    const FrameBatch heard = collect(drives_, send(masters_, out_, true, failed));
    out_.clear();
    sim_.receive_burst(heard, time_us_ - cycle_us_, time_us_);
    answers_.clear();
    sim_.advance_to(time_us_, answers_);
    const FrameBatch told = collect(masters_, send(drives_, answers_, false, [](int) {}));
    for (const BusFrame& frame : told) bridge_.receive(frame.bus, frame.frame, time_us_);
    if (bridge_.end_sampling(time_us_, state_)) {
      command_.stamp = {time_us_, state_.stamp.seq};
      command_.valid_until_utime_us = time_us_ + 5 * cycle_us_;
      bridge_.command(command_, time_us_);
    }
    bridge_.emit_setpoints(time_us_, out_);
  }
  bool run_until(SafetyLevel level, int ticks) {
    while (ticks-- > 0 && !(bridge_.operational() && bridge_.safety().level == level)) tick();
    return ticks > 0;
  }
  OperatorOutcome clear() {
    OperatorCommand command;
    command.kind = OperatorKind::kClear;
    command.request_id = ++request_;
    OperatorReply reply = bridge_.operator_command(command, time_us_);
    for (int i = 0; i < 4000 && reply.outcome == OperatorOutcome::kAccepted; ++i) {
      tick();
      bridge_.next_reply(reply);
    }
    return reply.outcome;
  }

  const RobotConfig robot_ = load_robot(test::source_dir() + "/robots/pegasus");
  const std::int64_t cycle_us_ = std::llround(1e6 * robot_.cycle_s);
  BridgeCore bridge_{robot_, BridgeOptions{robot_.watchdogs}};
  SimCore sim_{robot_, SimOptions{}};
  Buses masters_ = open_all(robot_.buses.size());
  Buses drives_ = open_all(robot_.buses.size());
  std::ofstream log_{"/tmp/four-buses.txt"};
  DriveState state_{robot_.actuators.size()};
  DriveCommand command_{robot_.actuators.size()};
  FrameBatch out_, answers_;
  std::int64_t time_us_ = 0;
  std::int64_t request_ = 0;
};

TEST_F(FourBuses, TwelveDrivesAndFourCardsBootRunLoseALinkAndComeBack) {
  ASSERT_EQ(robot_.buses.size(), 4u);
  ASSERT_TRUE(run_until(SafetyLevel::kOperational, 4000)) << bridge_.boot_detail();
  for (int i = 0; i < 250; ++i) tick();
  EXPECT_EQ(bridge_.safety().level, SafetyLevel::kOperational) << bridge_.safety().detail.data();
  for (const NodeHealth& node : bridge_.bus_state().nodes)
    EXPECT_EQ(node.missing_samples, 0) << node.bus << "/" << node.node;

  ASSERT_EQ(std::system("ip link set can2 down"), 0);
  for (int i = 0; i < 250; ++i) tick();
  EXPECT_EQ(bridge_.safety().cause, SafetyCause::kBusLost);
  EXPECT_EQ(bridge_.bus_state().buses[2].condition, BusCondition::kLinkDown);
  EXPECT_EQ(bridge_.bus_state().buses[1].condition, BusCondition::kActive);

  ASSERT_EQ(std::system("ip link set can2 up"), 0);
  for (int i = 0; i < 50; ++i) tick();
  EXPECT_EQ(clear(), OperatorOutcome::kDone) << bridge_.safety().detail.data();
  EXPECT_TRUE(run_until(SafetyLevel::kOperational, 100)) << bridge_.safety().detail.data();
}

}  // namespace
}  // namespace sprung
