// A battery that answers SDO, one that is silent, one that does not know an object.
#include "drivers/bridge/battery_link.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drivers/canopen/protocol.h"

namespace sprung {
namespace {

using namespace canopen;

BatteryConfig robots_battery() {
  BatteryConfig config;
  config.bus = 0;
  config.node = 20;
  config.voltage = {0x6060, 0, 4, false, 1.0 / 1024.0};
  config.charge = {0x6081, 0, 1, false, 0.01};
  config.temperature = {0x6010, 0, 2, true, 0.125};
  return config;
}

class BatteryLinkTest : public ::testing::Test {
 protected:
  void run(double time_s) {
    for (const std::int64_t end_us = time_us_ + static_cast<std::int64_t>(1e6 * time_s); time_us_ < end_us;
         time_us_ += 1000) {
      CanFrame question;
      if (!link_.step(time_us_, question)) continue;
      ++questions_;
      EXPECT_EQ(question.id, sdo_client_id(20));
      if (silent_) continue;
      const ObjectId object = decode_sdo_request(question).object;
      const std::uint32_t value = object.index == 0x6060 ? 25 * 1024 : object.index == 0x6081 ? 63 : 0x00F0;
      link_.receive(object.index == refused_ ? sdo_server_abort(20, object, kAbortNoObject)
                                             : sdo_read_reply(20, object, value, 4));
    }
    link_.show(state_);
  }
  BatteryLink link_{robots_battery()};
  AuxiliaryState state_{0};
  std::int64_t time_us_ = 0;
  int questions_ = 0;
  bool silent_ = false;
  std::uint16_t refused_ = 0;
};

TEST_F(BatteryLinkTest, ReadsARoundOfThreeOnceASecond) {
  run(4.5);
  EXPECT_EQ(state_.battery_voltage_V, 25.0);
  EXPECT_EQ(state_.battery_charge_share, 0.63);
  EXPECT_EQ(state_.battery_temperature_degC, 30.0);
  EXPECT_EQ(questions_, 15);
}

TEST_F(BatteryLinkTest, SilentOneIsNotKnownAfterThreeSecondsAndIsBackWhenItSpeaks) {
  run(2.0);
  silent_ = true;
  run(2.0);
  EXPECT_EQ(state_.battery_voltage_V, 25.0) << "its last";
  run(3.0);
  EXPECT_TRUE(std::isnan(state_.battery_voltage_V));
  EXPECT_TRUE(std::isnan(state_.battery_charge_share));
  silent_ = false;
  run(2.0);
  EXPECT_EQ(state_.battery_voltage_V, 25.0);
}

TEST_F(BatteryLinkTest, ObjectThatItDoesNotHaveIsNotKnownAlone) {
  refused_ = 0x6081;
  run(3.0);
  EXPECT_TRUE(std::isnan(state_.battery_charge_share));
  EXPECT_EQ(state_.battery_voltage_V, 25.0);
  EXPECT_EQ(state_.battery_temperature_degC, 30.0);
}

TEST(BatteryLink, OfARobotWithoutABatteryAsksNobody) {
  BatteryLink link{BatteryConfig{}};
  CanFrame question;
  for (std::int64_t t = 0; t < 3'000'000; t += 1000) EXPECT_FALSE(link.step(t, question));
  EXPECT_FALSE(link.exists());
}

}  // namespace
}  // namespace sprung
