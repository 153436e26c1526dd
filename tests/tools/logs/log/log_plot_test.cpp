#include "tools/logs/log/log_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>

#include "tests/support/refusal.h"
#include "tests/tools/logs/log/robot_sample.h"
#include "tools/logs/log/picture_file.h"
#include "tools/logs/log/thin_series.h"

namespace sprung::log {
namespace {

using testing::HasSubstr;

TEST(ThinSeries, FewSamplesStayAsTheyAre) {
  ThinSeries series;
  for (int i = 0; i < 100; ++i) series.add(i, i % 7);
  ASSERT_EQ(series.x().size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(series.x()[i], static_cast<double>(i));
    EXPECT_EQ(series.y()[i], static_cast<double>(i % 7));
  }
}

TEST(ThinSeries, ManySamplesKeepEveryPeakAndTheirOrder) {
  ThinSeries series;
  constexpr int kSamples = 1'000'000;
  for (int i = 0; i < kSamples; ++i)
    series.add(i, i == 123'457 ? 50.0 : i == 765'431 ? -40.0 : std::sin(0.001 * i));
  const std::vector<double> x = series.x(), y = series.y();
  EXPECT_LE(x.size(), 2 * ThinSeries::kMostStretches);
  EXPECT_GE(x.size(), ThinSeries::kMostStretches / 2);
  EXPECT_TRUE(std::is_sorted(x.begin(), x.end()));
  const auto high = std::max_element(y.begin(), y.end()) - y.begin();
  const auto low = std::min_element(y.begin(), y.end()) - y.begin();
  EXPECT_EQ(x[high], 123'457.0);
  EXPECT_EQ(x[low], 765'431.0);
  EXPECT_LT(x.front(), 300.0);
  EXPECT_GT(x.back(), kSamples - 300.0);
}

TEST(ThinSeries, GapsStay) {
  ThinSeries series;
  for (int i = 0; i < 100'000; ++i) series.add(i, i == 50'000 ? std::nan("") : 1.0);
  const std::vector<double> y = series.y();
  EXPECT_EQ(std::count_if(y.begin(), y.end(), [](double value) { return std::isnan(value); }), 1);
}

class LogPlotTest : public testing::Test {
 protected:
  LogPlot plot(const std::vector<Kept>& events, PlotRequest request) {
    write_all(path_, events);
    Reader reader(path_);
    return collect_plot(reader, request);
  }
  static PlotRequest torques() {
    PlotRequest request;
    request.fields = {"JOINT_STATE.joints[*].gear_output_torque_Nm",
                      "JOINT_STATE.joints[0].estimated_position_rad"};
    return request;
  }
  LogFolder folder_;
  std::string path_ = folder_("robot.lcm");
};

TEST_F(LogPlotTest, AUnitIsAPlotAFieldACurve) {
  const LogPlot got = plot(robot_events(100), torques());
  ASSERT_EQ(got.plots.size(), 2u);
  EXPECT_EQ(got.plots[0].y.unit, "rad");
  EXPECT_EQ(got.plots[1].y.unit, "Nm");
  ASSERT_EQ(got.plots[1].series.size(), 2u);
  EXPECT_EQ(got.plots[0].title, "JOINT_STATE.joints[0].estimated_position_rad");
  EXPECT_EQ(got.plots[1].title, "JOINT_STATE.joints[...].gear_output_torque_Nm");
  EXPECT_EQ(got.plots[1].series[0].name, "0");
  EXPECT_EQ(got.plots[1].series[1].name, "1");
  EXPECT_EQ(got.plots[1].series[0].x.size(), 100u);
  EXPECT_DOUBLE_EQ(got.plots[1].series[0].x[50], 0.1);
  EXPECT_DOUBLE_EQ(got.plots[1].series[0].y[50], 0.5);
  EXPECT_TRUE(std::isnan(got.plots[1].series[1].y[9]));
}

TEST_F(LogPlotTest, CurvesOfSeveralChannelsKeepWhatTellsThemApart) {
  PlotRequest request;
  request.fields = {"JOINT_STATE.n_joints", "MOTION_STATE.n_legs", "MOTION_STATE.jumps_done", "IMU.no_such"};
  const LogPlot got = plot(robot_events(10), request);
  ASSERT_EQ(got.plots.size(), 1u);
  EXPECT_EQ(got.plots[0].title, "");
  EXPECT_EQ(got.plots[0].series[0].name, "JOINT_STATE.n_joints");
  EXPECT_THAT(got.unmatched, testing::ElementsAre("IMU.no_such"));
  request.fields = {"MOTION_STATE.n_legs", "MOTION_STATE.jumps_done"};
  const LogPlot one = plot(robot_events(10), request);
  EXPECT_EQ(one.plots[0].title, "MOTION_STATE");
  EXPECT_EQ(one.plots[0].series[0].name, "n_legs");
}

TEST_F(LogPlotTest, PhasesAreTheMotionsUnlessAskedOtherwise) {
  const LogPlot motion = plot(robot_events(100), torques());
  ASSERT_EQ(motion.plots[0].shades.size(), 2u);
  EXPECT_EQ(motion.plots[0].shades[0].name, "standing");
  EXPECT_EQ(motion.plots[0].shades[0].from, 0.0);
  EXPECT_DOUBLE_EQ(motion.plots[0].shades[0].to, 0.1);
  EXPECT_EQ(motion.plots[0].shades[1].name, "walking");
  PlotRequest request = torques();
  request.phases = "MOTION_STATE.legs[0].phase";
  EXPECT_EQ(plot(robot_events(100), request).plots[0].shades[0].name, "idle");
  request.phases = "";
  EXPECT_TRUE(plot(robot_events(100), request).plots[0].shades.empty());
}

TEST_F(LogPlotTest, ShadesEndWhereTheyAreTooManyAndThatIsSaid) {
  std::vector<Kept> events;
  for (int k = 0; k < 500; ++k) {
    events.push_back(joint_event(k));
    events.push_back(motion_event(k, k % 2 == 0 ? "standing" : "walking"));
  }
  const LogPlot got = plot(events, torques());
  const std::vector<report::Shade>& shades = got.plots[0].shades;
  ASSERT_EQ(shades.size(), 400u);
  EXPECT_NEAR(shades.back().from, 0.798, 1e-9);
  EXPECT_NEAR(shades.back().to, 0.8, 1e-9) << "not over the phases that follow";
  EXPECT_THAT(got.subtitle, HasSubstr("phases are shaded up to 0.800 s"));
}

TEST_F(LogPlotTest, PhasesThatAreNotThereAreNamed) {
  PlotRequest request = torques();
  request.phases = "MOTION_STATE.legs[0].phse";
  EXPECT_THAT(plot(robot_events(10), request).unmatched, testing::ElementsAre(request.phases));
  EXPECT_THAT(plot({joint_event(0), joint_event(1)}, torques()).unmatched, testing::IsEmpty())
      << "those that nobody asked for may be missing";
}

TEST_F(LogPlotTest, ASpanIsWhatIsDrawn) {
  PlotRequest request = torques();
  request.span = parse_span("0.1", "0.12");
  const LogPlot got = plot(robot_events(100), request);
  EXPECT_EQ(got.plots[1].series[0].x.size(), 10u);
}

TEST_F(LogPlotTest, NothingOrTooMuchIsRefused) {
  PlotRequest request;
  request.fields = {"JOINT_STATE.no_such_field"};
  EXPECT_THROW(plot(robot_events(5), request), std::invalid_argument);
  request.fields = {"*_STATE"};
  EXPECT_THROW(plot(robot_events(5), request), std::invalid_argument);
}

TEST_F(LogPlotTest, ARefusalNamesTheField) {
  const auto refusal = [this](const std::string& field) {
    PlotRequest request;
    request.fields = {field};
    return test::refusal_of([&] { plot(robot_events(5), request); });
  };
  EXPECT_THAT(refusal("JOINT_STATE.n_joint"),
              HasSubstr("'JOINT_STATE.n_joint'; did you mean 'JOINT_STATE.n_joints'?"));
  EXPECT_THAT(refusal("MOTION_STATE.state_name"), HasSubstr("no number to draw: only texts"));
}

TEST_F(LogPlotTest, PngIsAPictureOfThatSize) {
  if (std::system("command -v chromium >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "chromium is not installed. Run ./setup.";
  const LogPlot got = plot(robot_events(100), torques());
  constexpr int kWidth = 1200, kHeight = 850;
  const std::string png = folder_("plot.png");
  write_png(png, report::to_html(plot_report(got, "sprung log plot")), kWidth, kHeight);
  const std::string bytes = bytes_of(png);
  ASSERT_GT(bytes.size(), 25'000u);  // without its plots the page has fewer
  EXPECT_EQ(bytes.substr(1, 3), "PNG");
  const auto side = [&bytes](std::size_t at) {
    return (static_cast<std::uint8_t>(bytes[at + 2]) << 8) | static_cast<std::uint8_t>(bytes[at + 3]);
  };
  EXPECT_EQ(side(16), kWidth);
  EXPECT_EQ(side(20), kHeight);
}

}  // namespace
}  // namespace sprung::log
