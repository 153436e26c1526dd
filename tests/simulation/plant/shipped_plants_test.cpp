/// Shipped plants mean what they meant, however sim.yaml is written: every loaded value against a dump that
/// is kept in tests/simulation/plant/loaded_*.txt. To change one on purpose: SPRUNG_WRITE_DUMPS=1 and look at
/// git diff.
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/simulation/plant/sim_dump.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

class ShippedPlant : public testing::TestWithParam<const char*> {};

TEST_P(ShippedPlant, LoadsAsItWasKeptValueByValue) {
  const std::string now = dump_of(load_sim_config(load_robot(GetParam()), {}));
  const std::string kept = test::kept_dump(
      test::source_dir() + "/tests/simulation/plant/loaded_" + GetParam() + ".txt", now);
  EXPECT_GT(kept.size(), 1000u);
  EXPECT_EQ(test::first_difference(kept, now), "");
}

INSTANTIATE_TEST_SUITE_P(Robots, ShippedPlant,
                         testing::Values("fennec", "pegasus", "single_leg", "test_axis"));

}  // namespace
}  // namespace sprung::sim
