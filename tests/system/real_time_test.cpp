/// The same binaries in real time. Nothing here depends on how fast this machine is: overruns are read, not
/// judged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

class RealTime : public SystemTest {
 protected:
  nlohmann::json status() const { return nlohmann::json::parse(sprung("status --json").output); }

  /// Whether the bridge stopped the robot although the machine kept time: what the watchdogs are for is a
  /// stall.
  bool stopped_by_a_stall() const {
    return status()["safety"]["state"] != "operational" && machine_stalled();
  }
};

TEST_F(RealTime, TenSecondsAtOneKilohertzWithAJumpReportTheirOverruns) {
  up("realtime");
  const CommandResult stand = sprung("stand");
  const CommandResult jump = sprung("jump --report");
  nlohmann::json json = status();
  std::int64_t cycles = 0;
  while (cycles < 10'000) {
    if (stopped_by_a_stall()) GTEST_SKIP() << "this machine stalled for " << longest_stall_ms() << " ms";
    json = status();
    ASSERT_EQ(json["safety"]["state"], "operational") << json.dump(1);
    for (const auto& process : json["processes"]) {
      if (process["name"] == "sprung-can-bridge") cycles = process["cycles"];
    }
  }
  EXPECT_EQ(stand.status, 0) << stand.output;
  EXPECT_EQ(jump.status, 0) << jump.output;
  EXPECT_THAT(jump.output, testing::HasSubstr("  yes\n"));
  std::printf("%lld cycles: %s overruns, %s without a command\n", static_cast<long long>(cycles),
              json["safety"]["overruns"].dump().c_str(), json["safety"]["missed_cycles"].dump().c_str());
  EXPECT_TRUE(json["safety"]["overruns"].is_number());
  RecordProperty("overruns", json["safety"]["overruns"].dump());
}

TEST_F(RealTime, EmergencyStopInAJumpIsLatched) {
  up("realtime");
  ASSERT_EQ(sprung("stand").status, 0);
  ASSERT_EQ(sprung("jump --no-wait").status, 0);
  const CommandResult estop = sprung("estop");
  EXPECT_EQ(estop.status, 0) << estop.output;
  const auto json = nlohmann::json::parse(sprung("status --json").output);
  EXPECT_EQ(json["safety"]["state"], "disabled");
  EXPECT_EQ(json["safety"]["cause"], "emergency stop");
  EXPECT_NE(sprung("stand").status, 0);
}

}  // namespace
}  // namespace sprung
