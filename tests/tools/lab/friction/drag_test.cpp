/// The link moved from outside, through the whole stack.
#include "tools/lab/friction/drag.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "robots/robot_loader.h"
#include "tools/lab/friction/drag_report.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;

class Drag : public testing::Test {
 protected:
  static void SetUpTestSuite() { result_ = new DragResult(run_drag(bench(), "best", {}, 0)); }
  /// As before `sprung identify`.
  static RobotConfig bench() {
    RobotConfig robot = load_robot("test_axis");
    robot.joints[0].friction.reset();
    return robot;
  }
  static void TearDownTestSuite() {
    delete result_;
    result_ = nullptr;
  }
  static const DragPhaseResult& phase(const std::string& name) {
    const auto found = std::find_if(result_->phases.begin(), result_->phases.end(),
                                    [&](const DragPhaseResult& p) { return p.name == name; });
    if (found == result_->phases.end()) throw std::runtime_error("no phase " + name);
    return *found;
  }

  static DragResult* result_;
};

DragResult* Drag::result_ = nullptr;

TEST_F(Drag, EveryReadingOfTheSensorIsScoredOnce) {
  EXPECT_TRUE(result_->sensed);
  for (const DragPhaseResult& p : result_->phases) {
    const double expected = 300.0 * (p.to_s - p.from_s);
    EXPECT_NEAR(static_cast<double>(p.samples.size()), expected, 2.0) << p.name;
    for (std::size_t i = 1; i < p.samples.size(); ++i)
      ASSERT_GT(p.samples[i].time_s, p.samples[i - 1].time_s) << p.name;
  }
}

TEST_F(Drag, TheHandTakesTheUnpoweredArmAlong) {
  const DragPhaseResult& brisk = phase("off_brisk_strokes");
  double low = 1e9, high = -1e9;
  for (std::size_t i = 0; i < result_->trace.time_s.size(); ++i) {
    if (result_->trace.time_s[i] < brisk.from_s || result_->trace.time_s[i] > brisk.to_s) continue;
    low = std::min(low, result_->trace.angle_rad[i]);
    high = std::max(high, result_->trace.angle_rad[i]);
  }
  EXPECT_GT(high - low, 1.3);
}

TEST_F(Drag, WithoutPowerTheLinkFeelsFrictionOfTheGearAndThePapersEquationOnlyItsConstant) {
  // Back-driven, the gear resists with more than breakaway friction; the motor gives nothing.
  EXPECT_GT(phase("off_brisk_strokes").score.reference_rms_Nm, 5.0);
  for (const DragSample& s : phase("off_brisk_strokes").samples) ASSERT_LT(std::abs(s.paper_Nm), 5.0);
}

TEST_F(Drag, ScoresOfPhasesMakeTheWhole) {
  double squares = 0.0;
  std::size_t count = 0;
  for (const DragPhaseResult& p : result_->phases) {
    ASSERT_TRUE(std::isfinite(p.score.rms_Nm)) << p.name;
    squares += p.score.rms_Nm * p.score.rms_Nm * static_cast<double>(p.score.samples);
    count += p.score.samples;
  }
  EXPECT_EQ(count, result_->all.samples);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(count)), result_->all.rms_Nm, 1e-9);
}

TEST_F(Drag, RowsAndReportNameEveryPhase) {
  const std::vector<ReportRow> rows = drag_rows(*result_, "drag");
  EXPECT_EQ(rows.size(), 5 * (result_->phases.size() + 1));
  const std::string html = report::to_html({"title", "", "", {drag_section(*result_)}});
  for (const DragPhaseResult& p : result_->phases) {
    EXPECT_THAT(html, HasSubstr(p.name));
    EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const ReportRow& row) {
      return row.name == "drag." + p.name + ".coverage";
    }));
  }
  EXPECT_THAT(html, HasSubstr("torque sensor"));
  EXPECT_THAT(drag_table(*result_), HasSubstr("not identified"));
}

TEST_F(Drag, AnotherSeedIsOtherNoiseOnTheSameDrag) {
  SimOptions sim;
  sim.seed = 2;
  const DragResult other = run_drag(bench(), "best", sim, 0);
  EXPECT_NE(other.all.rms_Nm, result_->all.rms_Nm);
  EXPECT_NEAR(other.all.reference_rms_Nm, result_->all.reference_rms_Nm,
              0.05 * result_->all.reference_rms_Nm);
}

}  // namespace
}  // namespace sprung
