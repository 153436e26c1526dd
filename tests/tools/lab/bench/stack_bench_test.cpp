#include "tools/lab/bench/stack_bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "robots/robot_loader.h"
#include "signals/vec3.h"

namespace sprung {
namespace {

class StackBench : public testing::Test {
 protected:
  double value(const std::string& name) const {
    const auto row = std::find_if(rows_.begin(), rows_.end(),
                                  [&](const ReportRow& r) { return r.name == "inprocess.pegasus." + name; });
    EXPECT_NE(row, rows_.end()) << name;
    return row == rows_.end() ? kNaN : row->value;
  }
  const RobotConfig robot_ = load_robot("pegasus");
  const std::vector<ReportRow> rows_ = bench_stack(robot_, 0.5);
};

TEST_F(StackBench, EveryPartHasATimeAndARatioAndTheyAddUp) {
  double sum_us = 0.0;
  for (const char* part : {"simulation", "bridge", "estimator", "planner", "controller"}) {
    const double us = value(std::string(part) + "_cycle");
    EXPECT_GT(us, 0.0) << part;
    EXPECT_GT(value(std::string(part) + "_cycle_ratio"), 0.0) << part;
    sum_us += us;
  }
  EXPECT_NEAR(value("cores_cycle"),
              value("estimator_cycle") + value("planner_cycle") + value("controller_cycle") -
                  value("force_distribution_two_feet"),
              1e-9);
  EXPECT_LT(value("cores_cycle"), sum_us);
  EXPECT_GT(value("force_distribution_four_feet"), 0.0);
  EXPECT_GT(value("cores_processor_mean"), 0.0);
  EXPECT_GT(value("cores_processor_p9999"), 0.0);
  EXPECT_GT(value("realtime_factor"), 0.0);
}

/// By construction, whatever the machine does: more work cannot be faster.
TEST_F(StackBench, TheStackIsSlowerThanItsSimulation) {
  EXPECT_GT(value("simulation_over_mj_step"), value("stack_over_mj_step"));
  for (const ReportRow& row : rows_) EXPECT_TRUE(std::isfinite(row.value)) << row.name;
}

TEST(StackBenchRefusal, ARobotThatDoesNotWalkIsRefused) {
  EXPECT_THROW(bench_stack(load_robot("single_leg"), 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
