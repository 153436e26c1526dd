#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tests/support/enumerators.h"
#include "tools/common/report/report.h"

namespace sprung::report {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

using Column = std::vector<double>;

constexpr double kReportPlotJsonNan = std::numeric_limits<double>::quiet_NaN();

Plot plot_of(std::vector<Series> series) {
  return {"torque", {"time", "s"}, {"torque", "Nm"}, std::move(series)};
}

Json json_of(const Plot& plot) { return Json::parse(plots_json({&plot})).at(0); }

TEST(PlotJson, EveryStyleHasItsOwnName) { test::expect_own_names<Style>(); }

TEST(PlotJson, AxesCarryTheirUnits) {
  Plot plot = plot_of({});
  EXPECT_EQ(json_of(plot)["x"], "time (s)");
  plot.y.unit = "";
  EXPECT_EQ(json_of(plot)["y"], "torque");
}

TEST(PlotJson, WhatIsNotFiniteIsNull) {
  const Json json = json_of(
      plot_of({{"knee", {0.0, 1.0, kReportPlotJsonNan}, {kReportPlotJsonNan, HUGE_VAL, 2.0}}}));
  EXPECT_EQ(json["series"][0]["x"], Json::parse("[0.0, 1.0, null]"));
  EXPECT_EQ(json["series"][0]["y"], Json::parse("[null, null, 2.0]"));
}

TEST(PlotJson, NumbersAreShort) {
  const Plot plot = plot_of({{"knee", {0.1 + 0.2, 1.0}, {2.0 / 3.0, 1.0}}});
  EXPECT_THAT(plots_json({&plot}), HasSubstr("\"x\":[0.3,1.0],\"y\":[0.666667,1.0]"));
}

TEST(PlotJson, LongSeriesAreThinnedAndSayHowLongTheyWere) {
  Plot plot = plot_of({{"line", {}, {}}, {"path", {}, {}}, {"cloud", {}, {}, Style::kPoints}});
  for (int i = 0; i < 50000; ++i) {
    plot.series[0].x.push_back(i);
    plot.series[1].x.push_back(i % 1000 == 999 ? -1.0 : i);
    plot.series[2].x.push_back((i * 7919) % 50021);
    for (Series& series : plot.series) series.y.push_back((i * 31) % 997);
  }
  plot.max_points = 1000;
  const Json all = json_of(plot)["series"];
  for (const Json& series : all) {
    EXPECT_EQ(series["samples"], 50000);
    EXPECT_LE(series["x"].size(), 1004u) << series["name"];
    EXPECT_GE(series["x"].size(), 400u) << series["name"];
    EXPECT_EQ(series["x"].size(), series["y"].size());
  }
}

TEST(PlotJson, AGapInXOfALongLineStays) {
  Plot plot = plot_of({{"line", Column(5000, 1.0), Column(5000, 1.0)}});
  plot.series[0].x[2500] = kReportPlotJsonNan;
  plot.max_points = 100;
  EXPECT_THAT(json_of(plot)["series"][0]["x"], testing::Contains(Json(nullptr)));
}

TEST(PlotJson, ColoursThatNobodyNamedAreNewOnes) {
  Plot plot = plot_of({{"a", {}, {}}, {"b", {}, {}, Style::kLine, 1}, {"c", {}, {}}});
  plot.bands = {{"bound of b", {}, {}, {}, 1}, {"other", {}, {}, {}}};
  const Json json = json_of(plot);
  EXPECT_EQ(json["series"][0]["colour"], 2);
  EXPECT_EQ(json["series"][1]["colour"], 1);
  EXPECT_EQ(json["series"][2]["colour"], 3);
  EXPECT_EQ(json["bands"][0]["colour"], 1);
  EXPECT_EQ(json["bands"][1]["colour"], 4);
}

TEST(PlotJson, AThinnedBandKeepsItsWidestPlace) {
  Plot plot = plot_of({});
  Band band{"bound", {}, Column(10000, -1.0), Column(10000, 1.0)};
  for (int i = 0; i < 10000; ++i) band.x.push_back(i);
  band.low[4321] = -8.0;
  band.high[8765] = 9.0;
  plot.bands = {band};
  const Json json = json_of(plot)["bands"][0];
  EXPECT_THAT(json["low"], testing::Contains(Json(-8.0)));
  EXPECT_THAT(json["high"], testing::Contains(Json(9.0)));
  EXPECT_LE(json["x"].size(), 3002u);
}

TEST(PlotJson, ShadesAndMarkersAreThere) {
  Plot plot = plot_of({});
  plot.shades = {{0.0, 0.5, "stand"}, {0.5, HUGE_VAL, "crouch"}};
  plot.markers = {{0.7, "lift-off"}};
  plot.equal_axes = true;
  const Json json = json_of(plot);
  EXPECT_EQ(json["shades"][1], Json::parse(R"({"from": 0.5, "to": null, "name": "crouch"})"));
  EXPECT_EQ(json["markers"][0], Json::parse(R"({"x": 0.7, "name": "lift-off"})"));
  EXPECT_EQ(json["equal"], true);
}

TEST(PlotJson, NamesCannotEndTheScriptAndBrokenUtf8IsReplaced) {
  const Plot plot = plot_of({{"</script><b>", {}, {}}, {"\xff", {}, {}}});
  EXPECT_THAT(plots_json({&plot}), testing::Not(HasSubstr("<")));
  EXPECT_EQ(json_of(plot)["series"][0]["name"], "</script><b>");
  EXPECT_EQ(json_of(plot)["series"][1]["name"], "\ufffd");
}

TEST(PlotJson, UnequalLengthsAreRefusedByName) {
  const Plot plot = plot_of({{"knee", {0.0, 1.0}, {0.0}}});
  try {
    plots_json({&plot});
    FAIL() << "accepted";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "plot \"torque\", \"knee\": 2 samples of x, 1 of y");
  }
  Plot banded = plot_of({});
  banded.bands = {{"bound", {0.0}, {0.0}, {}}};
  EXPECT_THROW(plots_json({&banded}), std::invalid_argument);
}

}  // namespace
}  // namespace sprung::report
