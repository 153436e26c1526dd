#include "tools/lab/landing/drop_ablation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mutex>
#include <set>

#include "robots/robot_loader.h"
#include "tests/tools/lab/landing/drop_sample.h"

namespace sprung {
namespace {

using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

/// On landings that were made up.
class DropAblationTest : public testing::Test {
 protected:
  std::vector<AblationRow> run() {
    request_.jobs = 2;
    return run_drop_ablation(
        robot_, request_, [this](const RunScript& script, const CycleObserver& watch, const ReplyObserver&) {
          play_landing(script, peak_Nm_(script), folds_, watch);
        });
  }
  static double row(const std::vector<AblationRow>& ablation, const std::string& name) {
    for (const ReportRow& row : ablation_rows(ablation))
      if (row.name == "drop.ablation." + name) return row.value;
    throw std::out_of_range(name);
  }
  static const AdaptiveLandingConfig& landing(const RunScript& script) {
    return script.robot.preset("best").adaptive_landing;
  }

  RobotConfig robot_ = load_robot("single_leg");
  DropRequest request_;
  bool folds_ = false;
  std::function<double(const RunScript&)> peak_Nm_ = [](const RunScript&) { return 10.0; };
};

TEST_F(DropAblationTest, EveryCaseChangesTheLandingAndNamesDiffer) {
  const PresetConfig& preset = robot_.preset("best");
  std::set<std::string> names;
  for (const AblationCase& c : ablation_cases()) {
    AdaptiveLandingConfig changed = preset.adaptive_landing;
    c.take_out(preset, changed);
    const AdaptiveLandingConfig& as_is = preset.adaptive_landing;
    const bool same = changed.extended_length_m == as_is.extended_length_m &&
                      changed.approach_m_s == as_is.approach_m_s && changed.timing_s == as_is.timing_s &&
                      changed.foot_x_m == as_is.foot_x_m && changed.air.mass_z_kg == as_is.air.mass_z_kg &&
                      changed.ground.mass_z_kg == as_is.ground.mass_z_kg &&
                      changed.ground.stiffness_z_N_m == as_is.ground.stiffness_z_N_m &&
                      changed.body_mass_kg == as_is.body_mass_kg;
    EXPECT_EQ(same, std::string(c.name) == "all") << c.name;
    names.insert(c.name);
  }
  EXPECT_THAT(names, SizeIs(ablation_cases().size()));
}

TEST_F(DropAblationTest, EachCaseIsRunWithItsOwnParametersAndThePapersLawLast) {
  std::mutex mutex;
  int paper = 0;
  peak_Nm_ = [&](const RunScript& script) {
    if (script.preset == "paper") {
      const std::lock_guard<std::mutex> lock(mutex);
      EXPECT_EQ(script.commands.back().jump_mode, JumpMode::kHybrid);
      ++paper;
      return 50.0;
    }
    EXPECT_EQ(script.commands.back().jump_mode, JumpMode::kAdaptive);
    return landing(script).foot_x_m == 0.0 ? 30.0 : 20.0;
  };
  const std::vector<AblationRow> ablation = run();
  ASSERT_THAT(ablation, SizeIs(ablation_cases().size() + 1));
  EXPECT_EQ(paper, static_cast<int>(ablation_drops().size()));
  EXPECT_EQ(row(ablation, "all.mean_300"), 20.0);
  EXPECT_EQ(row(ablation, "no_foot_place.mean_300"), 30.0);
  EXPECT_EQ(row(ablation, "no_braking.worst"), 20.0);
  EXPECT_EQ(row(ablation, "paper.worst"), 50.0);
}

TEST_F(DropAblationTest, MeanAndWorstAreOfTheComparedHeightAloneAndFoldedLegsAreCounted) {
  folds_ = true;
  peak_Nm_ = [&](const RunScript& script) {
    const double height_m = script.sim.plant.at("suspended") -
                            script.robot.preset(script.preset).stand_length_m -
                            script.robot.legs[0].foot_radius_m;
    const bool compared = std::abs(height_m - 0.3) < 1e-9;
    const bool early = script.controls.front().value > 1e-6;
    return compared ? (early ? 30.0 : 20.0) : 40.0;
  };
  const std::vector<AblationRow> ablation = run();
  EXPECT_NEAR(row(ablation, "all.mean_300"), (2 * 30.0 + 3 * 20.0) / 5, 1e-12);
  EXPECT_EQ(row(ablation, "all.worst_300"), 30.0);
  EXPECT_EQ(row(ablation, "all.worst"), 40.0);
  EXPECT_EQ(row(ablation, "all.folded"), static_cast<double>(ablation_drops().size()));
}

TEST_F(DropAblationTest, TableHasALineForEachCaseAndMarksFoldedLegs) {
  const std::string text = ablation_table(run());
  EXPECT_THAT(text, StartsWith("| true gear output"));
  EXPECT_THAT(text, HasSubstr("| adaptive landing as it is | 10.0 |"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'),
            static_cast<std::ptrdiff_t>(ablation_cases().size() + 3));
  folds_ = true;
  EXPECT_THAT(ablation_table(run()), HasSubstr("10.0 folded"));
}

TEST_F(DropAblationTest, PresetWithoutAnAdaptiveLandingIsRefused) {
  request_.preset = "paper";
  EXPECT_THROW(run(), std::invalid_argument);
  request_.preset = "none";
  EXPECT_THROW(run(), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
