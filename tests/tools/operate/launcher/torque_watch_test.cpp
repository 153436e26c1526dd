#include "tools/operate/launcher/torque_watch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/own_port.h"
#include "tools/operate/launcher/run_description.h"

namespace sprung {
namespace {

DriveState both(PowerState state) {
  DriveState out(2);
  for (ActuatorState& actuator : out.actuators) actuator.power_state = state;
  return out;
}

TEST(MayHaveTorque, OnlyWhereTheMotorIsDrivenOrNobodyKnows) {
  for (const auto state : {PowerState::kUnknown, PowerState::kOperationEnabled, PowerState::kQuickStopActive,
                           PowerState::kFaultReactionActive})
    EXPECT_TRUE(may_have_torque(both(state))) << static_cast<int>(state);
  for (const auto state : {PowerState::kNotReadyToSwitchOn, PowerState::kSwitchOnDisabled,
                           PowerState::kReadyToSwitchOn, PowerState::kSwitchedOn, PowerState::kFault})
    EXPECT_FALSE(may_have_torque(both(state))) << static_cast<int>(state);
}

TEST(MayHaveTorque, OneDriveIsEnough) {
  DriveState state = both(PowerState::kSwitchOnDisabled);
  state.actuators[1].power_state = PowerState::kOperationEnabled;
  EXPECT_TRUE(may_have_torque(state));
}

TEST(TorqueWatch, HearsTheBridgeOfItsSession) {
  const NodeOptions options{lcm_url_on_port(own_port()), 77, 0, {}};
  const TorqueWatch watch(options, load_robot("single_leg"));
  EXPECT_FALSE(watch.heard());
  Node bridge(options);
  auto publisher = bridge.publisher<DriveState>(channels::kDriveState);
  DriveState state = both(PowerState::kSwitchOnDisabled);
  state.stamp = {123'456, 5};
  for (int i = 0; i < 4000 && !watch.heard(); ++i) {
    publisher.publish(state);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_TRUE(watch.heard());
  EXPECT_FALSE(watch.heard()->any);
  EXPECT_EQ(watch.heard()->utime_us, 123'456);
}

}  // namespace
}  // namespace sprung
