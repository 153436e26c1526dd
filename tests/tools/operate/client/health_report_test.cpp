#include "tools/operate/client/health_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

namespace sprung {
namespace {

using ::testing::HasSubstr;

sprung_msgs::node_health_t healthy_node() {
  sprung_msgs::node_health_t node{};
  node.operational = 1;
  node.nmt_state = 5;
  return node;
}

TEST(HealthReport, HealthyNodeHasNoTrouble) { EXPECT_EQ(node_trouble(healthy_node()), ""); }

TEST(HealthReport, TroubleNamesEveryCounterThatIsNotZero) {
  sprung_msgs::node_health_t node = healthy_node();
  node.emergencies = 2;
  node.last_emergency_code = 0x8130;
  node.missing_samples = 3;
  node.implausible_samples = 4;
  EXPECT_EQ(node_trouble(node),
            "2 emergencies (last 0x8130 life guard or heartbeat lost), 3 samples missing, 4 implausible");
  node.operational = 0;
  EXPECT_THAT(node_trouble(node), HasSubstr("not operational, 2 emergencies"));
}

TEST(HealthReport, WarmWindingIsToldBeforeItLimitsAndWhenItDoes) {
  sprung_msgs::node_health_t node = healthy_node();
  node.winding_share = 0.79;
  EXPECT_EQ(node_trouble(node), "");
  node.winding_share = 0.87;
  EXPECT_EQ(node_trouble(node), "winding at 87 % of its warmth");
  node.limited_winding = 3;
  node.winding_share = 1.02;
  EXPECT_EQ(node_trouble(node),
            "3 held for the winding, winding at 102 % of its warmth: the rated current alone");
}

TEST(HealthReport, SafetyThatIsLatchedSaysWhatToTypeNext) {
  sprung_msgs::safety_state_t state{};
  state.level_name = "quick stop";
  state.cause_name = "drive silent";
  state.detail = "hip_motor: did not answer SYNC for 31 cycles";
  state.latched = 1;
  EXPECT_EQ(safety_text(safety_json(state)),
            "safety  quick stop, cause drive silent: hip_motor: did not answer SYNC for 31 cycles\n"
            "        next: sprung clear, then sprung stand");
  state = {};
  state.level_name = "operational";
  state.cause_name = "none";
  EXPECT_EQ(safety_text(safety_json(state)), "safety  operational, cause none");
  EXPECT_EQ(safety_text(safety_json(state, 0.94)),
            "safety  operational, cause none; STALE: nothing heard of the bridge for 0.9 s");
  state.detail = "was damping in cycle 5210, command stale: no good DRIVE_COMMAND for 71 ms";
  EXPECT_EQ(safety_text(safety_json(state)), "safety  operational, cause none: " + state.detail +
                                                 "\n        over by itself; sprung clear forgets it");
  EXPECT_EQ(safety_text(safety_json(std::nullopt)), "safety  unknown, cause the bridge says nothing");
}

TEST(HealthReport, JsonHoldsTheCountersByTheirNames) {
  sprung_msgs::bus_state_t state{};
  state.nodes.push_back(healthy_node());
  state.nodes[0].implausible_samples = 7;
  state.nodes[0].bus = 9;
  const auto json = nodes_json(RobotConfig{}, state);
  ASSERT_EQ(json.size(), 1U);
  EXPECT_EQ(json[0]["implausible_samples"], 7);
  EXPECT_EQ(json[0]["nmt_state"], "operational");
  EXPECT_TRUE(json[0]["bus"].is_null()) << "the robot has no such bus";
}

TEST(HealthReport, TemperaturesAndBatteryAreShownWhereTheRobotHasThem) {
  RobotConfig robot;
  robot.actuators.resize(2);
  robot.actuators[0].name = "hip_motor";
  robot.actuators[0].temperature.reading.index = 0x22A2;
  robot.actuators[1].name = "knee_motor";
  robot.battery.bus = 0;
  robot.battery.min_charge_share = 0.15;
  sprung_msgs::auxiliary_state_t state{};
  state.measured_temperature_degC = {41.25, 20.0};
  state.battery_voltage_V = 47.5;
  state.battery_charge_share = 0.12;
  state.battery_temperature_degC = std::nan("");
  const auto json = auxiliary_json(robot, state);
  EXPECT_EQ(json["temperatures_degC"].dump(), R"({"hip_motor":41.25})");
  EXPECT_TRUE(json["battery"]["temperature_degC"].is_null());
  EXPECT_THAT(auxiliary_lines(json),
              testing::ElementsAre("battery 12 %, 47.5 V, ? degC; LOW: let the robot sit, then charge",
                                   "drives  hip_motor 41.2 degC"));
  EXPECT_TRUE(auxiliary_lines(auxiliary_json(robot, std::nullopt)).empty());
}

TEST(HealthReport, RecoveryTextMayFillItsField) {
  sprung_msgs::node_health_t node = healthy_node();
  EXPECT_EQ(recovery_text(node), "");
  std::memset(node.recovery, 'x', sizeof node.recovery);
  EXPECT_EQ(recovery_text(node), std::string(128, 'x'));
}

}  // namespace
}  // namespace sprung
