#include "tools/lab/landing/drop_experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <mutex>
#include <tuple>

#include "robots/robot_loader.h"
#include "tests/tools/lab/landing/drop_sample.h"
#include "tools/common/parallel.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Ge;
using testing::Le;
using testing::SizeIs;

/// Two seeds from 7 on, on landings that were made up.
class DropExperimentTest : public testing::Test {
 protected:
  DropExperimentTest() {
    request_.sim.seed = 7;
    request_.seeds = 2;
    request_.jobs = 2;
  }
  DropExperiment run() {
    return run_drop_experiment(
        robot_, request_, [this](const RunScript& script, const CycleObserver& watch, const ReplyObserver&) {
          play_landing(script, peak_Nm_(script), folds_, watch);
        });
  }
  static const ReportRow& row(const DropExperiment& experiment, const std::string& name) {
    for (const ReportRow& row : experiment.rows)
      if (row.name == "drop." + name) return row;
    throw std::out_of_range(name);
  }

  RobotConfig robot_ = load_robot("single_leg");
  DropRequest request_;
  bool folds_ = false;
  std::function<double(const RunScript&)> peak_Nm_ = [](const RunScript& script) {
    return script.preset == "paper" ? 50.0 : 10.0 + static_cast<double>(script.sim.seed);
  };
};

TEST_F(DropExperimentTest, EveryModeLandsFromEveryHeight) {
  peak_Nm_ = [](const RunScript& script) {
    const double height_m = script.sim.plant.at("suspended") -
                            script.robot.preset(script.preset).stand_length_m -
                            script.robot.legs[0].foot_radius_m;
    return 100.0 * static_cast<double>(script.commands.back().jump_mode) + 10.0 * height_m;
  };
  const DropExperiment experiment = run();
  ASSERT_THAT(experiment.landings, SizeIs(4 * 5));
  for (const JumpMode mode :
       {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid, JumpMode::kAdaptive}) {
    for (const int height_mm : {100, 200, 300, 400, 500}) {
      const std::string name = std::string(sprung::name(mode)) + "_" + std::to_string(height_mm);
      EXPECT_NEAR(row(experiment, name + ".peak_output_torque").value,
                  100.0 * static_cast<double>(mode) + 0.01 * height_mm, 1e-9);
      EXPECT_NEAR(row(experiment, name + ".peak_motor_torque").value,
                  0.5 * row(experiment, name + ".peak_output_torque").value, 1e-9);
      EXPECT_EQ(row(experiment, name + ".folded").value, 0.0);
    }
  }
}

TEST_F(DropExperimentTest, ProgressCountsLandingsAndSeedsTogether) {
  std::vector<std::pair<std::size_t, std::size_t>> told;
  request_.on_progress = [&](std::size_t done, std::size_t count) { told.emplace_back(done, count); };
  run();
  ASSERT_THAT(told, SizeIs(26));
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], std::pair(i + 1, std::size_t{26}));
}

TEST_F(DropExperimentTest, BothLawsOfASeedMeetTheSameSurprise) {
  std::mutex mutex;
  std::map<std::tuple<std::string, std::uint64_t>, double> floor_m;
  peak_Nm_ = [&](const RunScript& script) {
    const std::lock_guard<std::mutex> lock(mutex);
    if (script.controls.front().value != 0.0)  // else one of the landings
      floor_m[{script.preset, script.sim.seed}] = script.controls.front().value;
    return 1.0;
  };
  const DropExperiment experiment = run();
  ASSERT_THAT(experiment.pairs, SizeIs(6)) << "two seeds from 0.3 m, one from each other height";
  ASSERT_THAT(floor_m, SizeIs(4));
  for (const DropPair& pair : experiment.pairs) {
    EXPECT_EQ(pair.surprise_s, drawn_surprise_s(pair.seed - 7 + request_.floor, 0.010));
    for (const char* preset : {"best", "paper"})
      EXPECT_EQ((floor_m.at({preset, pair.seed}) < 0.0), pair.surprise_s > 0.0) << preset << pair.seed;
  }
  EXPECT_EQ(experiment.pairs[0].seed, 7u);
  EXPECT_EQ(experiment.pairs[1].seed, 8u);
}

TEST_F(DropExperimentTest, FloorsAreOfTheirOwnNumberAndTheSeedIsOfTheNoiseAlone) {
  const auto surprises = [this](std::uint64_t seed, std::uint64_t floor) {
    request_.sim.seed = seed;
    request_.floor = floor;
    std::vector<double> out;
    for (const DropPair& pair : run().pairs) out.push_back(pair.surprise_s);
    return out;
  };
  EXPECT_EQ(surprises(7, 1), surprises(8, 1));
  EXPECT_NE(surprises(7, 1), surprises(7, 2));
}

TEST_F(DropExperimentTest, HalfThePapersPeakIsDemandedFromEveryHeight) {
  peak_Nm_ = [&](const RunScript& script) { return script.preset == "paper" ? 50.0 : 26.0; };
  const DropExperiment experiment = run();
  for (const int height_mm : {100, 200, 300, 400, 500}) {
    const ReportRow& over = row(experiment, "adaptive_over_paper_" + std::to_string(height_mm) + ".ratio");
    EXPECT_NEAR(over.value, 0.52, 1e-9);
    EXPECT_FALSE(over.ok());
  }
}

TEST_F(DropExperimentTest, ComparisonIsOfTheMeansAndNamesTheWorst) {
  const DropExperiment experiment = run();  // own 17 and 18 Nm, the papers' law 50 Nm
  EXPECT_NEAR(row(experiment, "adaptive_over_paper.ratio").value, 17.5 / 50.0, 1e-12);
  EXPECT_NEAR(row(experiment, "adaptive_over_paper.worst_ratio").value, 18.0 / 50.0, 1e-12);
  EXPECT_NEAR(row(experiment, "adaptive_over_paper.adaptive_mean").value, 17.5, 1e-12);
  EXPECT_NEAR(row(experiment, "adaptive_over_paper.adaptive_max").value, 18.0, 1e-12);
  EXPECT_NEAR(row(experiment, "adaptive_over_paper.paper_mean").value, 50.0, 1e-12);
  EXPECT_TRUE(all_ok(experiment.rows));
}

TEST_F(DropExperimentTest, HalfThePapersPeakIsDemandedAndNoLegFolded) {
  peak_Nm_ = [](const RunScript& script) { return script.preset == "paper" ? 50.0 : 25.1; };
  EXPECT_FALSE(all_ok(run().rows));
  peak_Nm_ = [](const RunScript& script) { return script.preset == "paper" ? 50.0 : 24.9; };
  EXPECT_TRUE(all_ok(run().rows));
  folds_ = true;
  const DropExperiment folded = run();
  EXPECT_EQ(row(folded, "adaptive_over_paper.folded").value, 2.0);
  EXPECT_EQ(row(folded, "hybrid_100.folded").value, 1.0);
  EXPECT_FALSE(all_ok(folded.rows));
}

TEST_F(DropExperimentTest, RowsAreTheSameWhateverTheThreadsAndSayWhatRan) {
  const DropExperiment two = run();
  request_.jobs = 1;
  const DropExperiment one = run();
  ASSERT_EQ(one.rows.size(), two.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    EXPECT_EQ(one.rows[i].name, two.rows[i].name);
    EXPECT_EQ(one.rows[i].value, two.rows[i].value) << one.rows[i].name;
  }
  EXPECT_EQ(one.simulated_s, two.simulated_s);
  EXPECT_THAT(one.simulated_s / (20 + 2 * 2), AllOf(Ge(2.0), Le(10.0)));  // of each drop
}

TEST_F(DropExperimentTest, FewerThanOneSeedIsRefusedAndAFailedDropNamed) {
  for (const int seeds : {0, -1}) {
    request_.seeds = seeds;
    EXPECT_THROW(run(), std::invalid_argument) << seeds;
  }
  request_.seeds = 1;
  peak_Nm_ = [](const RunScript&) -> double { throw std::runtime_error("the plant failed"); };
  EXPECT_THROW(run(), CaseError);
}

}  // namespace
}  // namespace sprung
