#include "simulation/plant/torque_sensor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace sprung::sim {
namespace {

/// Readings of a constant torque over a time, asked every quarter of a millisecond as the plant does.
std::vector<TorqueSensor> readings(TorqueSensorDevice& sensor, double torque_Nm, std::int64_t time_us) {
  std::vector<TorqueSensor> all;
  for (std::int64_t us = 250; us <= time_us; us += 250) {
    if (!sensor.due(us)) continue;
    sensor.read({us, us / 1000}, torque_Nm);
    all.push_back(sensor.sample(sensor.count() - 1));
  }
  return all;
}

TEST(TorqueSensorDevice, ReadsAtItsOwnRateOnTheStepsOfThePlant) {
  TorqueSensorDevice sensor({0, 300.0, 0.0, 0.0}, 1);
  const std::vector<TorqueSensor> all = readings(sensor, 5.0, 1'000'000);
  EXPECT_NEAR(static_cast<double>(all.size()), 300.0, 1.0);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double due_us = 1e6 / 300.0 * static_cast<double>(i);
    EXPECT_GE(static_cast<double>(all[i].stamp.utime_us), due_us);
    EXPECT_LT(static_cast<double>(all[i].stamp.utime_us), due_us + 250.0);
    EXPECT_EQ(all[i].measured_torque_Nm, 5.0);
  }
}

TEST(TorqueSensorDevice, NoiseHasItsSizeAndNoBias) {
  TorqueSensorDevice sensor({0, 300.0, 0.1, 0.0}, 1);
  double sum = 0.0, squares = 0.0;
  const std::vector<TorqueSensor> all = readings(sensor, 5.0, 20'000'000);
  for (const TorqueSensor& one : all) {
    sum += one.measured_torque_Nm - 5.0;
    squares += std::pow(one.measured_torque_Nm - 5.0, 2);
  }
  const double n = static_cast<double>(all.size());
  EXPECT_NEAR(sum / n, 0.0, 4.0 * 0.1 / std::sqrt(n));
  EXPECT_NEAR(std::sqrt(squares / n), 0.1, 0.004);
}

TEST(TorqueSensorDevice, ShowsWholeStepsOfItsResolution) {
  TorqueSensorDevice sensor({0, 300.0, 0.1, 0.025}, 1);
  for (const TorqueSensor& one : readings(sensor, -3.21, 1'000'000)) {
    const double steps = one.measured_torque_Nm / 0.025;
    EXPECT_NEAR(steps, std::round(steps), 1e-9);
    EXPECT_NEAR(one.measured_torque_Nm, -3.21, 0.4);
  }
}

TEST(TorqueSensorDevice, SameSeedSameBitsOtherSeedOthers) {
  TorqueSensorDevice one({0, 300.0, 0.1, 0.0}, 1), same({0, 300.0, 0.1, 0.0}, 1),
      other({0, 300.0, 0.1, 0.0}, 2);
  const auto a = readings(one, 1.0, 100'000), b = readings(same, 1.0, 100'000),
             c = readings(other, 1.0, 100'000);
  bool differs = false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].measured_torque_Nm, b[i].measured_torque_Nm);
    differs = differs || a[i].measured_torque_Nm != c[i].measured_torque_Nm;
  }
  EXPECT_TRUE(differs);
}

TEST(TorqueSensorDevice, KeepsTheNewestSixteen) {
  TorqueSensorDevice sensor({0, 300.0, 0.0, 0.0}, 1);
  for (int i = 0; i < 20; ++i) sensor.read({i, i}, i);
  EXPECT_EQ(sensor.count(), 20);
  for (int n = 4; n < 20; ++n) EXPECT_EQ(sensor.sample(n).measured_torque_Nm, n);
}

TEST(TorqueSensorDevice, WithoutAJointThereIsNoSensor) {
  const TorqueSensorDevice none({}, 1);
  EXPECT_FALSE(none.due(1'000'000));
  EXPECT_EQ(none.sample(0).joint, -1);
}

}  // namespace
}  // namespace sprung::sim
