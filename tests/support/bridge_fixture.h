#pragma once
/// A robot of fake drives that stands under torque, for tests of what goes wrong then.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "signals/bus_state.h"
#include "tests/support/bridge_bench.h"

namespace sprung::test {

class PoweredBridge : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(bench_.boot());
    bench_.enable();
    ASSERT_EQ(enabled(), 2);
    for (auto& drive : bench_.drives) enabled_before_.push_back(drive.enabled_count);
  }

  int enabled() const { return bench_.enabled(); }
  int powered() const {
    int count = 0;
    for (const auto& drive : bench_.drives) {
      count += drive.power == PowerState::kOperationEnabled || drive.power == PowerState::kQuickStopActive
                   ? 1
                   : 0;
    }
    return count;
  }
  SafetyLevel level() const { return bench_.bridge->safety().level; }
  SafetyCause cause() const { return bench_.bridge->safety().cause; }
  bool latched() const { return bench_.bridge->safety().latched; }
  /// Commands torque for a while: nothing may come on again.
  void expect_stays_off() {
    bench_.command_all(DriveMode::kTorque, 5.0);
    bench_.run(300);
    EXPECT_EQ(enabled(), 0);
    for (std::size_t i = 0; i < bench_.drives.size(); ++i) {
      EXPECT_EQ(bench_.drives[i].enabled_count, enabled_before_[i]) << "drive " << i << " was enabled again";
    }
  }

  std::string recovery(std::size_t node) const {
    return bench_.bridge->bus_state().nodes[node].recovery.data();
  }
  const NodeHealth& health(std::size_t node) const { return bench_.bridge->bus_state().nodes[node]; }

  BridgeBench bench_;
  std::vector<int> enabled_before_;
};

}  // namespace sprung::test
