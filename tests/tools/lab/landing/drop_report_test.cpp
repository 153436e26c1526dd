#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/tools/lab/landing/drop_sample.h"
#include "tools/lab/landing/drop_experiment.h"

namespace sprung {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::SizeIs;

/// Peaks tell the mode: 10 Nm in the first, 40 in the last.
void play(const RunScript& script, const CycleObserver& watch, const ReplyObserver&) {
  play_landing(script, 10.0 * (1.0 + static_cast<double>(script.commands.back().jump_mode)), false, watch);
}

class DropReportTest : public testing::Test {
 protected:
  DropReportTest() {
    DropResult stood, fell;
    stood.peak_motor_torque_Nm = 51.5;
    stood.peak_output_torque_Nm = 21.75;
    stood.touchdown_speed_m_s = 2.5;
    stood.folded = false;
    experiment_.landings = {{JumpMode::kAdaptive, 0.3, stood}, {JumpMode::kTorque, 0.5, fell}};
    for (int i = 0; i < 3; ++i) {
      DropPair pair;
      pair.height_m = 0.3;
      pair.surprise_s = 0.005 * (i - 1);
      pair.adaptive.peak_output_torque_Nm = 20.0 + i;
      pair.paper.peak_output_torque_Nm = 50.0 + i;
      experiment_.pairs.push_back(pair);
    }
    experiment_.pairs.push_back({0.5, 1, 0.004, {}, {}});  // of the rows alone
    sections_ = drop_sections(load_robot("single_leg"), {}, experiment_, play);
  }
  DropExperiment experiment_;
  std::vector<report::Section> sections_;
};

TEST_F(DropReportTest, EveryLandingIsARowWithBothTorques) {
  const report::Table& table = sections_.at(0).tables.at(0);
  ASSERT_THAT(table.rows, SizeIs(2));
  EXPECT_THAT(table.rows, Each(SizeIs(table.columns.size())));
  std::vector<std::string> first;
  for (const report::Cell& cell : table.rows[0]) first.push_back(cell.text);
  EXPECT_THAT(first, ElementsAre("adaptive", "0.3", "51.5", "21.75", "2.5", "no"));
  EXPECT_EQ(table.rows[1].front().text, "torque");
  EXPECT_EQ(table.rows[1][2].text, "-");  // it never touched
  EXPECT_EQ(table.rows[1].back().text, "yes");
}

TEST_F(DropReportTest, BothLawsAreDrawnOverTheSurprise) {
  const report::Plot& plot = sections_.at(1).plots.at(0);
  ASSERT_THAT(plot.series, SizeIs(2));
  for (const report::Series& series : plot.series) EXPECT_THAT(series.x, ElementsAre(-5.0, 0.0, 5.0));
  EXPECT_THAT(plot.series[0].y, ElementsAre(20.0, 21.0, 22.0));
  EXPECT_THAT(plot.series[1].y, ElementsAre(50.0, 51.0, 52.0));
}

TEST_F(DropReportTest, OneDropIsDrawnInEachModeFromTheRelease) {
  const report::Section& one = sections_.at(2);
  ASSERT_THAT(one.plots, SizeIs(3));  // length, gear output, motor side
  for (const report::Plot& plot : one.plots) {
    std::vector<std::string> names;
    for (const report::Series& series : plot.series) {
      names.push_back(series.name);
      EXPECT_THAT(series.y, SizeIs(400));
      EXPECT_EQ(series.x.front(), 0.0);
    }
    EXPECT_THAT(names, ElementsAre("position", "torque", "hybrid", "adaptive"));
  }
  EXPECT_DOUBLE_EQ(one.plots[0].series[3].y.back(), 0.5);
  EXPECT_DOUBLE_EQ(one.plots[1].series[3].y.back(), 40.0);  // of the knee, without its sign
  EXPECT_DOUBLE_EQ(one.plots[2].series[3].y.back(), 20.0);
  EXPECT_NO_THROW(report::to_html({"drop", "", "", sections_}));
}

}  // namespace
}  // namespace sprung
