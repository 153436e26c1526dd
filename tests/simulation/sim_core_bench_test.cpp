// The bench with one axis and a torque sensor.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/simulation/node/test_master.h"

namespace sprung::sim {
namespace {

/// What test_axis shows of a run with torque and a push at the arm's end: its drive and its torque sensor.
struct BenchStory {
  std::vector<DriveAnswer> answers;
  std::vector<TorqueSensor> readings;
};

BenchStory bench_story(const SimOptions& options) {
  SimMaster master(options, shipped("test_axis"));
  master.boot();
  master.enable();
  SimControl push;
  push.apply_at_seq = 100;
  push.actuator = 0;
  push.wrench = {20, 0, 0, 0, 0, 0};
  push.duration_s = 0.1;
  master.sim.control(push);
  BenchStory story;
  std::int64_t seen = master.sim.torque_reading_count();
  for (int i = 0; i < 600; ++i) {
    master.drive(1, {{1, {200 + i % 50, 0, 10}}});
    story.answers.push_back(master.drives[1]);
    while (seen < master.sim.torque_reading_count())
      story.readings.push_back(master.sim.torque_reading(seen++));
  }
  EXPECT_FALSE(master.sim.failed());
  return story;
}

bool same_readings(const BenchStory& a, const BenchStory& b) {
  return std::equal(a.readings.begin(), a.readings.end(), b.readings.begin(), b.readings.end(),
                    [](const TorqueSensor& x, const TorqueSensor& y) {
                      return x.measured_torque_Nm == y.measured_torque_Nm &&
                             x.stamp.utime_us == y.stamp.utime_us && x.stamp.seq == y.stamp.seq;
                    });
}

TEST(SimCoreBench, TruthOffChangesNothingOfTheBenchAndItsTorqueSensor) {
  SimOptions blind;
  blind.truth = false;
  const BenchStory seen = bench_story({}), unseen = bench_story(blind);
  EXPECT_TRUE(seen.answers == unseen.answers);
  EXPECT_TRUE(same_readings(seen, unseen));
  SimOptions other;
  other.seed = 2;
  EXPECT_FALSE(same_readings(seen, bench_story(other)));
}

TEST(SimCoreBench, TorqueSensorReadsWhatTheArmFeelsThreeHundredTimesASecond) {
  SimOptions quiet;
  quiet.plant = {{"noise_scale", 0.0}};
  const BenchStory story = bench_story(quiet);
  EXPECT_NEAR(static_cast<double>(story.readings.size()), 180.0, 1.0);
  for (const TorqueSensor& reading : story.readings) EXPECT_EQ(reading.joint, 0);
  SimMaster master(quiet, shipped("test_axis"));
  master.boot();
  EXPECT_LT(master.sim.torque_reading_count(), 2);
  master.enable();
  for (int i = 0; i < 1000; ++i) master.drive(1, {{1, {450, 0, 10}}});  // leans against the weight
  const double true_Nm = master.sim.truth().joints[0].true_gear_output_torque_Nm;
  EXPECT_GT(std::abs(true_Nm), 5.0);
  EXPECT_NEAR(master.sim.torque_sensor().measured_torque_Nm, true_Nm, 0.5 * 0.025 + 0.02);
  EXPECT_LE(master.time_us - master.sim.torque_sensor().stamp.utime_us, 4000);
}

TEST(SimCoreBench, RobotsWithoutATorqueSensorReadNone) {
  SimMaster master;
  master.boot();
  master.ticks(50);
  EXPECT_EQ(master.sim.torque_reading_count(), 0);
  EXPECT_EQ(master.sim.torque_sensor().joint, -1);
}

}  // namespace
}  // namespace sprung::sim
