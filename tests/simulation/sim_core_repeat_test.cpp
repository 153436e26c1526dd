// The same frames and seed give the same bits, and what must not matter does not.
#include <gtest/gtest.h>

#include <vector>

#include "tests/simulation/node/test_master.h"

namespace sprung::sim {
namespace {

TEST(SimCoreRepeat, EncoderNoiseAndLossesAreTheSameInEveryRun) {
  const auto run = [] {
    SimMaster master;
    master.boot();
    master.fault(FaultKind::kEncoderNoise, 0, 0.001);
    master.fault(FaultKind::kFramesLost, 1, 0.3);
    std::vector<DriveAnswer> answers;
    for (int i = 0; i < 200; ++i) {
      master.tick();
      answers.push_back(master.drives[1]);
      answers.push_back(master.drives[2]);
    }
    EXPECT_NEAR(master.drives[2].tpdo1_count, 0.5 * 200, 40);  // neither all SYNCs heard nor all answers sent
    return answers;
  };
  EXPECT_TRUE(run() == run());
}

/// Answers of a run with torque, noise, a fault and a push in it.
std::vector<DriveAnswer> story(const SimOptions& options) {
  SimMaster master(options);
  master.boot();
  master.enable();
  SimControl push;
  push.apply_at_seq = 100;
  push.wrench = {5, 0, 80, 0, 0, 0};
  push.duration_s = 0.05;
  master.sim.control(push);
  std::vector<DriveAnswer> answers;
  for (int i = 0; i < 400; ++i) {
    const int torque = 200 + i % 50;
    master.drive(1, {{1, {torque / 4, 0, 10}}, {2, {-torque, 0, 10}}});
    answers.push_back(master.drives[1]);
    answers.push_back(master.drives[2]);
  }
  EXPECT_FALSE(master.sim.failed());
  return answers;
}

TEST(SimCoreRepeat, SameFramesAndSeedGiveTheSameBits) {
  SimOptions options;
  options.plant = {{"sync_jitter_us", 5.0}};
  EXPECT_TRUE(story(options) == story(options));
}

TEST(SimCoreRepeat, AnotherSeedGivesOtherNoise) {
  SimOptions other;
  other.seed = 2;
  EXPECT_FALSE(story({}) == story(other));
}

TEST(SimCoreRepeat, TruthOffChangesNothingElse) {
  SimOptions blind;
  blind.truth = false;
  EXPECT_TRUE(story({}) == story(blind));
}

TEST(SimCoreRepeat, LateComputerIsTheSameInEveryRunAndAnotherThanOneInTime) {
  SimOptions late;
  late.plant = {{"compute_tail_us", 100.0}, {"missed_cycles", 0.05}, {"winding", 1.0}};
  const auto once = story(late);
  EXPECT_TRUE(once == story(late));
  EXPECT_FALSE(once == story({}));
  late.seed = 2;
  EXPECT_FALSE(once == story(late));
}

}  // namespace
}  // namespace sprung::sim
