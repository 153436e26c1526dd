#include "drivers/can/bus_addresses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

TEST(BusAddresses, RobotFilesOwnUnlessOverridden) {
  const RobotConfig robot = load_robot("single_leg");
  EXPECT_EQ(bus_addresses(robot, {}), std::vector<std::string>{robot.buses[0].can});
  EXPECT_EQ(bus_addresses(robot, {"leg=socketcan:can3"}), std::vector<std::string>{"socketcan:can3"});
}

TEST(BusAddresses, UnknownBusIsRefusedWithAnExample) {
  const RobotConfig robot = load_robot("single_leg");
  for (const char* text : {"arm=udp:239.1.1.1:1", "socketcan:can0", ""}) {
    EXPECT_THAT([&] { bus_addresses(robot, {text}); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("leg=socketcan:can0")))
        << text;
  }
}

TEST(BusAddresses, RobotOfARunCarriesTheAddressesReallyUsed) {
  const RobotConfig robot = load_robot("pegasus");
  const RobotConfig used = with_bus_addresses(robot, {"hl=socketcan:can7"});
  ASSERT_EQ(used.buses.size(), robot.buses.size());
  EXPECT_EQ(used.buses[2].can, "socketcan:can7");
  EXPECT_EQ(used.buses[2].name, "hl");
  EXPECT_EQ(used.buses[3].can, robot.buses[3].can);
}

TEST(OpenUdpBus, OtherBusesCannotRunInLockStep) {
  EXPECT_THAT([] { open_udp_bus("socketcan:can0"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("--clock realtime")));
}

TEST(BurstFaults, AreReadFromText) {
  const auto faults = parse_burst_faults({"can-drop:17:2", "can-repeat:18:0"});
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].tick, 17);
  EXPECT_EQ(faults[0].index, 2);
  EXPECT_EQ(faults[0].kind, BurstFault::Kind::kDrop);
  EXPECT_EQ(faults[1].kind, BurstFault::Kind::kRepeat);
}

TEST(BurstFaults, OtherTextsAreRefused) {
  for (const char* text : {"can-drop:17", "drop:17:2", "can-lose:17:2", "can-drop:17:2x", "can-drop:a:b"}) {
    EXPECT_THROW(parse_burst_faults({text}), std::invalid_argument) << text;
  }
}

}  // namespace
}  // namespace sprung
