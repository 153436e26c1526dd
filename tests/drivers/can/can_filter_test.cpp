#include "drivers/can/can_filter.h"

#include <gtest/gtest.h>

#include "drivers/can/memory_bus.h"
#include "drivers/canopen/protocol.h"
#include "robots/robot_config.h"

namespace sprung {
namespace {

bool bridge_sees(const std::vector<CanFilter>& filters, std::uint32_t id) {
  return passes(filters.data(), static_cast<int>(filters.size()), id);
}

/// Drives 1 and 2 and a card 40 on bus 0, drive 3 on bus 1.
RobotConfig robot() {
  RobotConfig robot;
  robot.actuators.resize(3);
  for (int i = 0; i < 3; ++i) robot.actuators[i].node = i + 1;
  robot.actuators[2].bus = 1;
  robot.encoder_cards.resize(1);
  robot.encoder_cards[0].node = 40;
  return robot;
}

TEST(CanFilter, MaskSaysWhichBitsCount) {
  const CanFilter exact{0x181};
  EXPECT_TRUE(passes(&exact, 1, 0x181));
  EXPECT_FALSE(passes(&exact, 1, 0x182));
  const CanFilter group{0x180, 0x780};
  EXPECT_TRUE(passes(&group, 1, 0x1FF));
  EXPECT_FALSE(passes(&group, 1, 0x281));
}

TEST(CanFilter, NoFilterMeansEverything) { EXPECT_TRUE(passes(nullptr, 0, 0x7FF)); }

TEST(BusFilters, EveryServiceOfTheBusesOwnNodesPasses) {
  const std::vector<CanFilter> filters = bus_filters(robot(), 0);
  for (const int node : {1, 2, 40}) {
    EXPECT_TRUE(bridge_sees(filters, canopen::emcy_id(node)));
    EXPECT_TRUE(bridge_sees(filters, canopen::sdo_server_id(node)));
    EXPECT_TRUE(bridge_sees(filters, canopen::heartbeat_id(node)));
    for (int n = 0; n < canopen::kPdoCount; ++n) EXPECT_TRUE(bridge_sees(filters, canopen::tpdo_id(n, node)));
  }
}

TEST(BusFilters, SecondMasterIsSeen) {
  const std::vector<CanFilter> filters = bus_filters(robot(), 0);
  EXPECT_TRUE(bridge_sees(filters, canopen::kNmtId));
  EXPECT_TRUE(bridge_sees(filters, canopen::kSyncId));
  EXPECT_TRUE(bridge_sees(filters, canopen::rpdo_id(0, 2)));
  EXPECT_TRUE(bridge_sees(filters, canopen::sdo_client_id(1)));
  EXPECT_TRUE(bridge_sees(filters, canopen::heartbeat_id(canopen::kBridgeNode)));
  EXPECT_TRUE(bridge_sees(filters, canopen::sdo_server_id(canopen::kBridgeNode))) << "a drive as delivered";
}

TEST(BusFilters, ForeignNodeIsSeenByItsHeartbeatAlone) {
  const std::vector<CanFilter> filters = bus_filters(robot(), 0);
  EXPECT_TRUE(bridge_sees(filters, canopen::heartbeat_id(3))) << "it is on another bus";
  EXPECT_FALSE(bridge_sees(filters, canopen::tpdo_id(0, 3)));
  EXPECT_FALSE(bridge_sees(filters, canopen::emcy_id(3)));
  EXPECT_TRUE(bridge_sees(bus_filters(robot(), 1), canopen::tpdo_id(0, 3)));
}

TEST(BusFilters, BackEndWithoutFiltersSaysSo) {
  MemoryBus bus(MemoryMedium::named("filters"));
  const CanFilter filter{0x181};
  EXPECT_FALSE(bus.accept_only(&filter, 1));
}

}  // namespace
}  // namespace sprung
