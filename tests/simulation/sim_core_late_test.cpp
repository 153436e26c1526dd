// Set-points of a computer that is late, or misses a cycle.
#include <gtest/gtest.h>

#include "tests/simulation/node/test_master.h"

namespace sprung::sim {
namespace {

constexpr int kLateHip = 1;  ///< node

/// Torque at the SYNC after the one up to which a first set-point of 100 per mille was sent.
double torque_after_set_point_Nm(const std::map<std::string, double>& plant) {
  SimOptions options;
  options.plant = plant;
  SimMaster master(options);
  master.boot();
  master.enable();
  master.drive(20, {{kLateHip, SetPoint{0, 0, 10}}});
  master.drive(1, {{kLateHip, SetPoint{100, 0, 10}}});
  master.tick();
  return master.sim.true_motor_torque_Nm(0);
}

TEST(LateComputer, SetPointThatComesAfterTheNextSyncActsLater) {
  const double soon_Nm = torque_after_set_point_Nm({{"compute_time_us", 0.0}});
  const double at_sync_Nm = torque_after_set_point_Nm({{"compute_time_us", 900.0}});
  const double late_Nm = torque_after_set_point_Nm({{"compute_time_us", 900.0}, {"compute_tail_us", 0.01}});
  EXPECT_GT(soon_Nm, at_sync_Nm + 0.1);
  EXPECT_GT(at_sync_Nm, late_Nm + 0.1);
  EXPECT_GT(late_Nm, 0.0);
}

TEST(LateComputer, MissedCyclesBringNoSetPointsButTheirOtherFrames) {
  SimOptions options;
  options.plant = {{"missed_cycles", 0.5}};
  SimMaster master(options);
  master.boot();
  int newest = 0;
  constexpr int kCycles = 200;
  for (int i = 1; i <= kCycles; ++i) {
    master.queue(SimMaster::rpdo1(kLateHip, SetPoint{i, 0, 10}));
    if (static_cast<int>(master.read(kLateHip, canopen::kTargetTorque)) == i)
      ++newest;  // by SDO, in each cycle
  }
  EXPECT_NEAR(newest, kCycles / 2, 30);
}

}  // namespace
}  // namespace sprung::sim
