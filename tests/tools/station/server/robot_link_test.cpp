#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/key_source.h"
#include "signals/auxiliary_state.h"
#include "tests/runtime/lcm_network.h"
#include "tests/support/own_folder.h"
#include "tools/station/server/robot_link_shell.h"

namespace sprung::station {
namespace {

/// A bridge's end of the network, of a robot that has a battery, and a drive that tells its temperature.
class Linked : public testing::Test {
 protected:
  Linked() {
    setenv("SPRUNG_RUN_DIR", folder_.path().c_str(), 1);
    info_.lcm_url = test::own_lcm_url();
    info_.session = 7;
    run_ = std::make_unique<RunFile>(info_.instance);
    run_->write_key(*random_key());
    robot_.battery.bus = 0;
    robot_.battery.min_charge_share = 0.15;
    robot_.actuators[1].temperature.reading.index = 0x22A2;
    link_ = std::make_unique<RobotLink>(info_, robot_);
    bridge_ = std::make_unique<Node>(commanding(info_));
  }
  ~Linked() override {
    bridge_.reset();
    link_.reset();
    run_.reset();
    unsetenv("SPRUNG_RUN_DIR");
  }
  AuxiliaryState warm() const {
    AuxiliaryState state(robot_.actuators.size());
    state.stamp = {1000, 1};
    state.measured_temperature_degC[1] = 41.25;
    state.battery_voltage_V = 47.5;
    state.battery_charge_share = 0.12;
    return state;
  }
  /// Says it again until that holds: the first datagrams may come before anybody listens.
  bool comes(const AuxiliaryState& state, const std::function<bool()>& heard) {
    auto out = bridge_->publisher<AuxiliaryState>(channels::kAuxiliaryState);
    for (int i = 0; i < 500; ++i) {
      out.publish(state);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      if (heard()) return true;
    }
    return false;
  }

  const test::OwnFolder folder_{"robot-link"};
  RunInfo info_;
  RobotConfig robot_ = load_robot("single_leg");
  std::unique_ptr<RunFile> run_;
  std::unique_ptr<RobotLink> link_;
  std::unique_ptr<Node> bridge_;
};

TEST_F(Linked, HearsTemperaturesAndBattery) {
  EXPECT_TRUE(health_json(robot_, link_->hear())["auxiliary"].is_null()) << "nothing was said yet";
  ASSERT_TRUE(comes(warm(), [this] { return link_->hear().auxiliary.message.has_value(); }));
  const auto told = health_json(robot_, link_->hear())["auxiliary"];
  EXPECT_EQ(told["temperatures_degC"][robot_.actuators[1].name], 41.25);
  EXPECT_EQ(told["battery"]["voltage_V"], 47.5);
  EXPECT_EQ(told["battery"]["low"], true);
}

TEST_F(Linked, ViewersGetThemToo) {
  RobotLink::Reader reader{channels::kAuxiliaryState, 0};
  EXPECT_TRUE(comes(warm(), [&] { return link_->newest(reader) != nullptr; }));
}

TEST_F(Linked, EveryChannelThatItNamesCanBeRead) {
  for (const auto& [channel, type] : RobotLink::channels_heard()) {
    RobotLink::Reader reader{channel, 0};
    EXPECT_EQ(link_->newest(reader), nullptr) << channel;
  }
}

TEST_F(Linked, OfAnotherNumberOfDrivesIsNotHeard) {
  AuxiliaryState other(robot_.actuators.size() + 1);
  other.stamp = {1000, 1};
  auto out = bridge_->publisher<AuxiliaryState>(channels::kAuxiliaryState);
  ASSERT_TRUE(comes(warm(), [this] { return link_->hear().auxiliary.message.has_value(); }));
  for (int i = 0; i < 10; ++i) out.publish(other);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_EQ(link_->hear().auxiliary.message->n_actuators, static_cast<int>(robot_.actuators.size()));
}

}  // namespace
}  // namespace sprung::station
