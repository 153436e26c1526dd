#include "tools/can/decode/bus_description.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung::cantools {
namespace {

TEST(BusDescription, HasEveryDriveAndCardWithItsEdsAndPdos) {
  const RobotConfig robot = load_robot("pegasus");
  const BusDescription description = describe_buses(robot);
  EXPECT_EQ(description.buses, (std::vector<std::string>{"fl", "fr", "hl", "hr"}));
  ASSERT_EQ(description.nodes.size(), robot.actuators.size() + robot.encoder_cards.size());
  for (const NodeDescription& node : description.nodes) {
    EXPECT_NE(node.eds, nullptr) << node.name;
    EXPECT_FALSE(node.pdos.empty()) << node.name;
    EXPECT_NE(node.actuator.has_value(), node.encoder_card.has_value()) << node.name;
    EXPECT_EQ(node.card != nullptr, node.encoder_card.has_value()) << node.name;
    EXPECT_EQ(node.card_channels.size(), node.encoder_card ? 3u : 0u) << node.name;
  }
}

TEST(BusDescription, TheSameNodeIdOnAnotherBusIsAnotherNode) {
  const BusDescription description = describe_buses(load_robot("pegasus"));
  EXPECT_EQ(description.node_name(0, 4), "fl_card");
  EXPECT_EQ(description.node_name(3, 4), "hr_card");
  EXPECT_EQ(description.find(0, 9), nullptr);
}

TEST(BusDescription, StrangersAndTheBridgeHaveNamesToo) {
  const BusDescription description = describe_buses(load_robot("single_leg"));
  EXPECT_EQ(description.node_name(0, 5), "node 5");
  EXPECT_EQ(description.node_name(0, canopen::kBridgeNode), "bridge");
  EXPECT_EQ(BusDescription{}.node_name(0, canopen::kBridgeNode), "node 127");  // nobody knows whose bus it is
}

TEST(BusDescription, AProfileThatThereIsNotIsRefused) {
  RobotConfig robot = load_robot("single_leg");
  robot.actuators[0].profile = "nobody";
  EXPECT_THROW(describe_buses(robot), std::invalid_argument);
}

}  // namespace
}  // namespace sprung::cantools
