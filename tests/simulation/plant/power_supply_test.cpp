#include "simulation/plant/power_supply.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung::sim {
namespace {

constexpr double kTick_s = 0.00025;

SupplyConfig battery() {
  SupplyConfig config;
  config.voltage_V = 48.0;
  config.resistance_ohm = 0.15;
  config.capacity_F = 0.01;
  return config;
}

double settled_V(PowerSupply& supply, double drawn_W, double time_s = 0.1) {
  for (int i = 0; i < static_cast<int>(time_s / kTick_s); ++i) supply.step(drawn_W, kTick_s);
  return supply.voltage_V();
}

TEST(PowerSupply, StaysWhereItIsWithoutLoad) {
  PowerSupply supply(battery());
  EXPECT_EQ(settled_V(supply, 0.0), 48.0);
}

/// V (V0 - V) / R = P.
TEST(PowerSupply, SagsByThePowerThatIsDrawnAndComesBack) {
  PowerSupply supply(battery());
  const double sagged_V = settled_V(supply, 600.0);
  EXPECT_NEAR(sagged_V, 24.0 + std::sqrt(24.0 * 24.0 - 0.15 * 600.0), 1e-6);
  EXPECT_NEAR(settled_V(supply, 0.0), 48.0, 1e-6);
  settled_V(supply, 600.0);
  supply.reset();
  EXPECT_EQ(supply.voltage_V(), 48.0);
}

TEST(PowerSupply, FollowsWithItsTimeConstant) {
  PowerSupply supply(battery());
  const double end_V = 24.0 + std::sqrt(24.0 * 24.0 - 0.15 * 100.0);
  const double after_V = settled_V(supply, 100.0, 0.0015);  // R C
  EXPECT_NEAR((48.0 - after_V) / (48.0 - end_V), 1.0 - std::exp(-1.0), 0.04);
}

TEST(PowerSupply, BatteryTakesBackWhatBrakes) {
  PowerSupply supply(battery());
  EXPECT_NEAR(settled_V(supply, -300.0), 24.0 + std::sqrt(24.0 * 24.0 + 0.15 * 300.0), 1e-6);
}

/// Its energy goes into the capacitor: C (V^2 - V0^2) / 2.
TEST(PowerSupply, BehindARectifierBrakingChargesTheCapacitor) {
  SupplyConfig config = battery();
  config.takes_back = false;
  PowerSupply supply(config);
  const double after_V = settled_V(supply, -100.0, 0.05);
  EXPECT_NEAR(0.5 * config.capacity_F * (after_V * after_V - 48.0 * 48.0), 5.0, 0.1);
  EXPECT_EQ(settled_V(supply, 0.0), after_V) << "nothing takes it out again";
}

TEST(PowerSupply, ChopperHoldsItsVoltageAsLongAsItsResistorTakesTheCurrent) {
  SupplyConfig config = battery();
  config.takes_back = false;
  config.chopper_V = 54.0;
  config.chopper_ohm = 2.0;
  PowerSupply supply(config);
  EXPECT_NEAR(settled_V(supply, -1000.0, 0.2), 54.0, 1e-9);
  EXPECT_NEAR(settled_V(supply, -2000.0, 1.0), std::sqrt(2.0 * 2000.0), 1.0) << "V^2 / R";
}

TEST(PowerSupply, BreaksDownUnderMoreThanItCanGive) {
  PowerSupply supply(battery());
  EXPECT_LT(settled_V(supply, 4500.0), 5.0) << "more than V0^2 / (4 R) = 3840 W";
  EXPECT_GE(supply.voltage_V(), PowerSupply::kLeast_V);
}

}  // namespace
}  // namespace sprung::sim
