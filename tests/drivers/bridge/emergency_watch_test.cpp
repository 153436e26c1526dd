#include "drivers/bridge/emergency_watch.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

constexpr std::uint16_t kOverTemperature = 0x4210;
constexpr std::uint16_t kLifeGuard = 0x8130;

class EmergencyWatchTest : public ::testing::Test {
 protected:
  void say(std::uint16_t code, std::uint8_t error_register = 0) { watch_.receive({code, error_register}); }
  NodeHealth shown() const {
    NodeHealth out;
    watch_.show(out);
    return out;
  }
  EmergencyWatch watch_;
};

TEST_F(EmergencyWatchTest, StandsUntilItIsWithdrawnAndWasJudged) {
  say(kOverTemperature, 0x08);
  say(0);
  watch_.begin_cycle();
  EXPECT_TRUE(watch_.stands()) << "nobody has judged it";
  watch_.judged();
  EXPECT_TRUE(watch_.stands());
  watch_.begin_cycle();
  EXPECT_FALSE(watch_.stands());
}

TEST_F(EmergencyWatchTest, OneOfSeveralThatIsGoneLeavesTheOther) {
  say(kOverTemperature, 0x09);
  say(0, 0x01);
  watch_.judged();
  watch_.begin_cycle();
  EXPECT_TRUE(watch_.stands());
  EXPECT_EQ(shown().error_register, 0x01);
}

TEST_F(EmergencyWatchTest, ANewOneIsJudgedAnew) {
  say(kOverTemperature, 0x08);
  watch_.judged();
  say(kLifeGuard, 0x10);
  say(0);
  watch_.begin_cycle();
  EXPECT_EQ(watch_.emergency().code, kLifeGuard);
}

TEST_F(EmergencyWatchTest, ACommunicationFaultStaysBehindLaterOnes) {
  say(kOverTemperature);
  EXPECT_FALSE(watch_.communication_fault());
  say(kLifeGuard);
  say(kOverTemperature);
  EXPECT_TRUE(watch_.communication_fault());
  watch_.forget();
  EXPECT_FALSE(watch_.communication_fault());
  EXPECT_FALSE(watch_.stands());
  say(0x8210);
  EXPECT_TRUE(watch_.communication_fault()) << "a PDO too short";
}

TEST_F(EmergencyWatchTest, CountsAndKeepsTheLastCodeAlsoWhenItIsGone) {
  say(kLifeGuard, 0x11);
  say(kOverTemperature, 0x09);
  say(0);
  watch_.forget();
  EXPECT_EQ(shown().emergencies, 2);
  EXPECT_EQ(shown().last_emergency_code, kOverTemperature);
  EXPECT_EQ(shown().error_register, 0);
}

}  // namespace
}  // namespace sprung
