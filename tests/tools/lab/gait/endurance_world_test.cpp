#include "tools/lab/gait/endurance_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/sim_core.h"

namespace sprung {
namespace {

TEST(EnduranceWorld, IsASlopeOrWavesOfWhatEveryGaitPassesWithAPayloadOnHalfOfThem) {
  const RobotConfig pegasus = load_robot("pegasus");
  int slopes = 0, waves = 0, payloads = 0;
  double steepest = 0.0, up = 0.0, down = 0.0;
  for (std::uint64_t number = 1; number <= 200; ++number) {
    const auto world = endurance_world(pegasus, number);
    EXPECT_EQ(world, endurance_world(pegasus, number));
    payloads += static_cast<int>(world.count("payload"));
    if (world.count("wave") > 0) {
      ++waves;
      EXPECT_LE(world.at("wave"), 0.03);
      continue;
    }
    ++slopes;
    const double along = std::tan(world.at("slope")), across = std::tan(world.at("side_slope"));
    steepest = std::max(steepest, std::hypot(along, across));
    up = std::max(up, along);
    down = std::min(down, along);
  }
  EXPECT_EQ(slopes + waves, 200);
  EXPECT_NEAR(slopes, 100, 25);
  EXPECT_NEAR(payloads, 100, 25);
  EXPECT_LE(steepest, std::tan(0.14662));
  EXPECT_GT(up, 0.1);
  EXPECT_LT(down, -0.1);
}

TEST(EnduranceWorld, IsAPlantThatThereIs) {
  const RobotConfig pegasus = load_robot("pegasus");
  for (std::uint64_t number = 1; number <= 4; ++number) {
    SimOptions sim;
    sim.plant = endurance_world(pegasus, number);
    EXPECT_NO_THROW(SimCore(pegasus, sim));
  }
}

}  // namespace
}  // namespace sprung
