/// pegasus as an operator walks it: lying on the floor, homed, up, away, and down again, each command as it
/// is typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "lcmtypes/channels.h"
#include "runtime/node.h"
#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class Walk : public SystemTest {
 protected:
  Walk() { robot_ = load_robot("pegasus"); }
  nlohmann::json status() const { return nlohmann::json::parse(sprung("status --json").output); }
  std::string state() const { return status()["motion"]["state"].get<std::string>(); }
  void obeys(const std::string& command) const {
    const CommandResult result = sprung(command);
    EXPECT_EQ(result.status, 0) << command << ": " << result.output;
    EXPECT_THAT(result.output, HasSubstr("done")) << command;
  }
  void refuses(const std::string& command, const std::string& why) const {
    const CommandResult result = sprung(command);
    EXPECT_NE(result.status, 0) << command;
    EXPECT_THAT(result.output, HasSubstr(why)) << command;
  }
  void stand_up() {
    up("lockstep");
    obeys("home --from link");
    obeys("stand");
  }
  /// The next SIM_TRUTH whose cycle is at least `seq`.
  sprung_msgs::sim_truth_t truth(std::int64_t seq = 0) const {
    const RunInfo run = info();
    InputQueue<sprung_msgs::sim_truth_t> truths(64);
    Node node({run.lcm_url, run.session, run.epoch_us, {}});
    node.subscribe_message(channels::kSimTruth,
                           CountLimits::exactly(robot_.joints.size(), robot_.legs.size()), truths);
    node.start();
    const auto timeout_us = static_cast<std::int64_t>(1e6 * kTimeout_s);
    for (const std::int64_t end_us = node.utime_us() + timeout_us; node.utime_us() < end_us;) {
      node.wait_for_input(end_us);
      while (auto heard = truths.pop()) {
        if (heard->seq >= seq) return *heard;
      }
    }
    throw std::runtime_error("no SIM_TRUTH");
  }
  sprung_msgs::sim_truth_t truth_in(double seconds) const {
    return truth(truth().seq + static_cast<std::int64_t>(seconds / robot_.cycle_s));
  }
};

TEST_F(Walk, FromTheFloorHomeStandTrotStopAndSit) {
  up("lockstep");
  refuses("stand", "sprung home");
  refuses("walk --speed 0.2", "stand first");
  const double lying_m = truth().base_in_world_m[2];
  EXPECT_LT(lying_m, 0.2) << "it starts on the floor";
  obeys("home --from link");
  obeys("stand");
  const auto begin = truth();
  EXPECT_NEAR(begin.base_in_world_m[2], robot_.preset("best").stand_length_m, 0.03);
  obeys("walk --gait trot --speed 0.2");
  const auto end = truth_in(5.0);
  EXPECT_GT(end.base_in_world_m[0] - begin.base_in_world_m[0], 0.6);
  EXPECT_NEAR(end.base_in_world_m[2], begin.base_in_world_m[2], 0.05);
  auto json = status();
  EXPECT_EQ(json["motion"]["state"], "walking");
  EXPECT_EQ(json["motion"]["gait"], "trot");
  EXPECT_NEAR(json["motion"]["desired_speed"][0].get<double>(), 0.2, 1e-9);
  EXPECT_TRUE(json["body"]["uses_imu"].get<bool>());
  EXPECT_LT(std::abs(json["body"]["roll_rad"].get<double>()), 0.2);
  EXPECT_NEAR(json["body"]["height_m"].get<double>(), 0.5, 0.05);
  obeys("walk --speed 0.1");  // as it goes
  obeys("stop");
  EXPECT_EQ(state(), "standing");
  obeys("sit");
  EXPECT_EQ(state(), "idle");
  json = status();
  EXPECT_EQ(json["safety"]["state"], "operational");
  EXPECT_EQ(json["safety"]["cause"], "none");
  EXPECT_LT(truth().base_in_world_m[2], lying_m + 0.15) << "it sits";
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 0);
}

TEST_F(Walk, WhatItCannotIsRefusedWithTheGaitsThereAre) {
  stand_up();
  EXPECT_EQ(sprung("walk --gait gallop").status, 2);
  refuses("walk --gait gallop", "crawl");
  refuses("walk --speed 2", "no gait goes 2 m/s");
  refuses("walk --gait crawl --speed 0.3", "crawl does not go 0.3 m/s");
  refuses("walk --height 0.9", "body height");
  refuses("walk --width 1", "stance width");
  refuses("walk --control wild", "prestance");
  EXPECT_EQ(state(), "standing");
}

TEST_F(Walk, StopWaitsUntilACrawlStands) {
  stand_up();
  obeys("walk --gait crawl --speed 0.1");
  truth_in(4.0);
  refuses("walk --gait trot --speed 0.3", "stop first");
  obeys("walk --speed 0.05");
  EXPECT_EQ(status()["motion"]["gait"], "crawl") << "another speed, not another gait";
  obeys("stop");
  EXPECT_EQ(state(), "standing");
}

/// To the left, lower, with feet further out.
TEST_F(Walk, SidewaysAtAnotherHeightAndWidth) {
  stand_up();
  const auto begin = truth();
  obeys("walk --gait trot --sideways 0.1 --height 0.48 --width 0.05");
  auto now = truth_in(5.0);
  EXPECT_NEAR(now.base_in_world_m[1] - begin.base_in_world_m[1], 0.45, 0.2);
  EXPECT_NEAR(now.base_in_world_m[0] - begin.base_in_world_m[0], 0.0, 0.15);
  EXPECT_NEAR(now.base_in_world_m[2], 0.48, 0.03);
  const auto apart_m = [](const sprung_msgs::sim_truth_t& t) {
    return t.legs[2].true_foot_in_world_m[1] - t.legs[3].true_foot_in_world_m[1];  // hind
  };
  double mean_m = 0.0;  // each foot is in the air for half of the time
  for (int i = 0; i < 10; ++i) mean_m += 0.1 * apart_m(now = truth_in(0.15));
  const LegConfig& leg = robot_.legs[2];
  EXPECT_NEAR(mean_m, 2.0 * (leg.hip_in_trunk_m[1] + leg.links[0].length_m + 0.05), 0.03);
  EXPECT_EQ(state(), "walking");
  obeys("stop");
  EXPECT_EQ(status()["safety"]["cause"], "none");
}

TEST_F(Walk, LegsAreControlledAsAskedAlsoAsItGoes) {
  stand_up();
  for (const char* control : {"hybrid", "force", "adaptive"}) {
    obeys(std::string("walk --gait trot --speed 0.1 --control ") + control);
    const auto begin = truth_in(0.5);
    const auto end = truth_in(1.5);
    EXPECT_NEAR(end.base_in_world_m[0] - begin.base_in_world_m[0], 0.15, 0.1) << control;
    EXPECT_EQ(state(), "walking") << control;
  }
  obeys("stop");
  EXPECT_EQ(state(), "standing");
}

TEST_F(Walk, OnItsSideItRefusesToStandAndSaysWhy) {
  up("lockstep", "--plant roll=1.57");
  truth_in(2.0);  // until it lies still
  obeys("home --from link");
  refuses("stand", "turn it over");
  EXPECT_EQ(state(), "idle");
  EXPECT_EQ(status()["safety"]["state"], "operational");
}

}  // namespace
}  // namespace sprung
