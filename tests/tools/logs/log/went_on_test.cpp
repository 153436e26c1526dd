#include "tools/logs/log/went_on.h"

#include <gtest/gtest.h>

#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::log {
namespace {

class WentOnTest : public testing::Test {
 protected:
  static const std::uint8_t* bytes(const std::string& data) {
    return reinterpret_cast<const std::uint8_t*>(data.data());
  }
  std::int64_t safety(std::int64_t missed_cycles, const std::string& cause = "none", std::int64_t seq = 1) {
    const std::string data = safety_event(seq, "operational", cause, "", missed_cycles).data;
    return went_on_.add_safety(bytes(data), data.size());
  }
  std::string status(const std::string& process, const std::string& detail) {
    const std::string data = status_event(1, process, detail).data;
    return went_on_.add_status(bytes(data), data.size());
  }

  WentOn went_on_;
};

TEST_F(WentOnTest, BridgeWithoutAnAnswerIsCountedFromTheFirstStateOn) {
  EXPECT_EQ(safety(2), 0) << "what was before the log";
  EXPECT_EQ(safety(2), 0);
  EXPECT_EQ(safety(5), 3);
  EXPECT_EQ(safety(1), 0) << "a bridge that counts anew";
  EXPECT_EQ(safety(2), 1);
}

TEST_F(WentOnTest, BeforeTheFirstCycleNothingWasMadeThatCouldBeMadeAgain) {
  EXPECT_EQ(safety(0, "starting", -1), 0);
  EXPECT_EQ(safety(3, "starting", -1), 0);
  EXPECT_EQ(safety(4, "none", 0), 1);
}

TEST_F(WentOnTest, AnOrderlyEndWaitsForNobody) {
  safety(2);
  EXPECT_EQ(safety(9, "shutdown"), 0);
  EXPECT_EQ(status("sprung-sim-drives", "no SYNC: this run is not deterministic"), "");
}

TEST_F(WentOnTest, ProcessThatSaysSoIsToldOnce) {
  EXPECT_EQ(status("sprung-sim-drives", "refused: wrong hash"), "");
  EXPECT_EQ(status("sprung-sim-drives", "no SYNC: this run is not deterministic"),
            "sprung-sim-drives: no SYNC");
  EXPECT_EQ(status("sprung-sim-drives", "no SYNC: this run is not deterministic"), "");
  EXPECT_EQ(status("sprung-can-bridge", "this run is not deterministic"), "sprung-can-bridge: ");
}

TEST_F(WentOnTest, WhatIsNoMessageSaysNothing) {
  const std::string data = "no message";
  EXPECT_EQ(went_on_.add_safety(bytes(data), data.size()), 0);
  EXPECT_EQ(went_on_.add_status(bytes(data), data.size()), "");
}

}  // namespace
}  // namespace sprung::log
