/// Cases on several threads: order, failures, progress, and the same bits as on one.
#include "tools/common/parallel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <numeric>
#include <set>
#include <thread>

#include "robots/robot_loader.h"
#include "tools/lab/jump/jump_experiment.h"

namespace sprung {
namespace {

using testing::HasSubstr;

TEST(Parallel, ResultsStandInTheOrderOfTheCasesWhateverTheThreads) {
  std::vector<int> squares(100);
  for (std::size_t i = 0; i < squares.size(); ++i) squares[i] = static_cast<int>(i * i);
  for (const int jobs : {1, 2, 7, 200}) {
    const auto square = [](std::size_t i) {
      if (i % 10 == 0) std::this_thread::yield();
      return static_cast<int>(i * i);
    };
    EXPECT_EQ(parallel_map(100, square, {jobs, {}}), squares) << jobs;
  }
  EXPECT_TRUE(parallel_map(0, [](std::size_t) { return 1; }).empty());
}

TEST(Parallel, UsesAsManyThreadsAsAsked) {
  std::atomic<int> waiting{0};
  const auto meet_the_others = [&](std::size_t) {  // ends only if three threads are in here together
    ++waiting;
    while (waiting < 3) std::this_thread::yield();
    return std::this_thread::get_id();
  };
  const auto ids = parallel_map(3, meet_the_others, {3, {}});
  EXPECT_EQ(std::set<std::thread::id>(ids.begin(), ids.end()).size(), 3u);
}

TEST(Parallel, TheFirstFailureByIndexIsReportedWithItsCaseAndNoFurtherCaseBegins) {
  for (const int jobs : {1, 2, 4}) {
    std::atomic<int> begun{0};
    const auto fails_from_five = [&](std::size_t i) {
      ++begun;
      if (i >= 5) throw std::runtime_error("leg " + std::to_string(i) + " fell");
    };
    try {
      run_parallel(1000, fails_from_five, {jobs, {}});
      FAIL() << "no failure";
    } catch (const CaseError& error) {
      EXPECT_STREQ(error.what(), "case 6 of 1000: leg 5 fell");
      EXPECT_EQ(error.index(), 5u);
    }
    EXPECT_LE(begun, 5 + jobs);
  }
}

TEST(Parallel, WhateverIsThrownIsAFailure) {
  EXPECT_THROW(run_parallel(3, [](std::size_t) { throw 7; }, {2, {}}), CaseError);
}

TEST(Parallel, ProgressCountsUpToTheEnd) {
  std::vector<std::size_t> seen;
  ParallelOptions options;
  options.jobs = 3;
  options.on_progress = [&](std::size_t done, std::size_t count) {
    EXPECT_EQ(count, 20u);
    seen.push_back(done);
  };
  run_parallel(
      20, [](std::size_t) {}, options);
  std::vector<std::size_t> expected(20);
  std::iota(expected.begin(), expected.end(), 1u);
  EXPECT_EQ(seen, expected);
}

TEST(Parallel, JobsAreCoresUnlessTheyAreGiven) {
  EXPECT_GE(job_count(0), 1);
  EXPECT_EQ(job_count(3), 3);
  EXPECT_THROW(job_count(-1), std::invalid_argument);
}

/// Every bit of what a jump's joints did; plants differ from case to case.
std::vector<double> jump_bits(const RobotConfig& robot, std::size_t index) {
  SimOptions sim;
  sim.seed = index + 1;
  sim.plant = {{"friction_scale", 0.9 + 0.1 * static_cast<double>(index)}, {"mass_scale", 1.05}};
  RunScript script = jump_script(robot, "best", sim, JumpMode::kHybrid, 1);
  script.cycles = std::min<std::int64_t>(script.cycles, 4700);
  std::vector<double> bits;
  run_in_process(
      script,
      [&](const CycleRecord& cycle) {
        for (std::size_t i = 0; i < robot.joints.size(); ++i) {
          bits.push_back(cycle.joint_state.joints[i].gear_output_torque_Nm);
          bits.push_back(cycle.joint_state.joints[i].estimated_position_rad);
        }
        bits.push_back(cycle.truth.base_in_world_m[2]);
      },
      [](const OperatorReply&) {});
  return bits;
}

TEST(Parallel, SimulatedJumpsOnTwoThreadsHaveTheBitsOfOne) {
  const RobotConfig robot = load_robot("single_leg");
  const auto run = [&](std::size_t index) { return jump_bits(robot, index); };
  const auto alone = parallel_map(3, run, {1, {}});
  const auto together = parallel_map(3, run, {3, {}});
  ASSERT_GT(alone[0].size(), 20000u);
  EXPECT_NE(std::memcmp(alone[0].data(), alone[1].data(), alone[0].size() * sizeof(double)), 0);
  for (std::size_t i = 0; i < alone.size(); ++i) {
    ASSERT_EQ(alone[i].size(), together[i].size());
    EXPECT_EQ(std::memcmp(alone[i].data(), together[i].data(), alone[i].size() * sizeof(double)), 0) << i;
  }
}

}  // namespace
}  // namespace sprung
