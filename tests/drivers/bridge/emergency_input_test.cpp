#include "drivers/bridge/emergency_input.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(EmergencyInputTest, WithoutABitThereIsNone) {
  const EmergencyInput none({-1, false});
  EXPECT_FALSE(none.exists());
  EXPECT_TRUE(none.known());
  EXPECT_FALSE(none.stops());
}

TEST(EmergencyInputTest, CutWireStopsWhereZeroStops) {
  EmergencyInput input({4, false});
  input.take(0x10);
  EXPECT_FALSE(input.stops());
  input.take(0xEF);
  EXPECT_TRUE(input.stops());
}

TEST(EmergencyInputTest, OneStopsWhereAskedFor) {
  EmergencyInput input({31, true});
  input.take(0x7FFFFFFF);
  EXPECT_FALSE(input.stops());
  input.take(0x80000000);
  EXPECT_TRUE(input.stops());
}

TEST(EmergencyInputTest, IsNotKnownUntilItWasReadAndAfterARestart) {
  EmergencyInput input({0, false});
  EXPECT_FALSE(input.known());
  EXPECT_FALSE(input.stops());
  input.take(0);
  EXPECT_TRUE(input.known() && input.stops());
  input.forget();
  EXPECT_FALSE(input.known() || input.stops());
}

}  // namespace
}  // namespace sprung
