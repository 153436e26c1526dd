#include "tools/lab/gait/stand_push.h"

#include <gtest/gtest.h>

#include <map>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

PushScore score(double motor_Nm, double output_Nm, double foot_off_mm) {
  PushScore out;
  out.excess_motor_Nm = motor_Nm;
  out.excess_output_Nm = output_Nm;
  out.foot_off_mm = foot_off_mm;
  return out;
}

std::map<std::string, ReportRow> rows_of(const StandPushResult& result) {
  std::map<std::string, ReportRow> out;
  for (const ReportRow& row : stand_push_rows(result)) out[row.name] = row;
  return out;
}

TEST(StandPushTest, RatioIsOfThePapersJointTorqueAndTheGearsOutputStandsBesideIt) {
  StandPushResult result;
  for (const TrunkPush& push : trunk_pushes())
    result.pushes.push_back({push, {score(20.0, 30.0, 7.0), {}}, {score(5.0, 27.0, 2.0), {}}});
  const auto rows = rows_of(result);
  for (const char* push : {"impulse", "pushdown", "lift", "impulse_30Ns", "pushdown_30mm", "pushforce"}) {
    const std::string name = std::string("stand_push.") + push;
    EXPECT_NEAR(rows.at(name + ".ratio").value, 0.25, 1e-12) << push;
    EXPECT_NEAR(rows.at(name + ".output_ratio").value, 0.9, 1e-12) << push;
    EXPECT_NEAR(rows.at(name + ".foot_off").value, 2.0, 1e-12) << push;
    EXPECT_EQ(rows.at(name + ".foot_off").high, 5.0) << push;
  }
  EXPECT_EQ(rows.at("stand_push.impulse.ratio").high, 0.4);
  EXPECT_EQ(rows.at("stand_push.pushdown.ratio").high, 0.6);
  EXPECT_FALSE(rows.at("stand_push.impulse_30Ns.ratio").high.has_value());
}

TEST(StandPushTest, SpringsSpareTheMotorsWhatAPoundPutsThroughEveryGear) {
  SimOptions sim;
  sim.seed = 1;
  const StandPushResult result = run_stand_push(load_robot("pegasus"), "best", sim, {trunk_pushes().at(3)},
                                                {2, {}});
  const auto rows = rows_of(result);
  EXPECT_LT(rows.at("stand_push.impulse_30Ns.ratio").value, 0.5);
  EXPECT_GT(rows.at("stand_push.impulse_30Ns.position").value, 10.0);
  EXPECT_GT(rows.at("stand_push.impulse_30Ns.output_ratio").value, 0.8);
  EXPECT_LT(rows.at("stand_push.impulse_30Ns.foot_off").value, 5.0);
  // As commanded, and not as one key of the preset says.
  EXPECT_GT(rows.at("stand_push.gains.friction_compensation").value,
            load_robot("pegasus").preset("best").walk.stance_friction_compensation);
  EXPECT_EQ(rows.at("stand_push.gains.stiffness_up").value, 4000.0);
}

}  // namespace
}  // namespace sprung
