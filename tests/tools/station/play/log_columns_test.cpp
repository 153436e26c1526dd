#include "tools/station/play/log_columns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace sprung::station {
namespace {

const std::vector<FrameField> kFields = {
    {"joints.hip.estimated_position_rad", "rad", {}, "JOINT_STATE", ""},
    {"joints.hip.estimated_velocity_rad_s", "rad/s", {}, "JOINT_STATE", ""},
    {"truth.base_in_world_m.x", "m", {}, "SIM_TRUTH", ""}};

Frame frame(std::int64_t k, float position) {
  return {0.001 * static_cast<double>(k), k, 1, {position, 2.0F, 3.0F}};
}

TEST(LogColumns, OfAShortLogAreEveryCycle) {
  LogColumns columns(kFields, 100);
  for (int k = 0; k < 100; ++k) columns.add(frame(k, 0.1F));
  const nlohmann::json found = columns.description();
  EXPECT_EQ(found["cycles"], 100);
  EXPECT_EQ(found["cycles_a_moment"], 1);
  EXPECT_EQ(found["moments"], 100);
  EXPECT_EQ(found["moment_fields"], nlohmann::json({0}));
  EXPECT_EQ(found["cycles_a_stretch"], 1);
  EXPECT_EQ(found["stretches"], 100);
  EXPECT_EQ(found["stretch_fields"], nlohmann::json({0, 1}));
}

TEST(LogColumns, OfALongLogKeepTheirBounds) {
  const ColumnLimits limits{50, 80};
  LogColumns columns(kFields, 1000, limits);
  for (int k = 0; k < 1000; ++k) columns.add(frame(k, 0.1F));
  const nlohmann::json found = columns.description();
  EXPECT_EQ(found["moments"], 50);
  EXPECT_LE(found["stretches"].get<int>() * 2 * 2, 80);
  EXPECT_GE(found["stretches"].get<int>(), 15);
}

TEST(LogColumns, OneThatWasNeverMeasuredIsLeftOut) {
  LogColumns columns(kFields, 10);
  for (int k = 0; k < 10; ++k) columns.add(frame(k, NAN));
  EXPECT_EQ(columns.description()["moment_fields"], nlohmann::json::array());
  EXPECT_EQ(columns.description()["stretch_fields"], nlohmann::json({1}));
}

/// One cycle's peak changes what is packed, however much is thinned; and a NaN beside it hides nothing.
TEST(LogColumns, NoPeakIsLost) {
  const auto packed = [](int peak_at, float peak) {
    LogColumns columns(kFields, 1000, {50, 80});
    for (int k = 0; k < 1000; ++k) columns.add(frame(k, k == peak_at ? peak : k == peak_at + 1 ? NAN : 0.1F));
    return columns.packed();
  };
  for (const int at : {1, 333, 777, 998}) {
    EXPECT_NE(packed(at, 50.0F), packed(at, 0.1F)) << at;
    EXPECT_NE(packed(at, -50.0F), packed(at, 0.1F)) << at;
  }
}

}  // namespace
}  // namespace sprung::station
