#include "tools/experiments/contact_experiment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

ContactStep step(double speed_m_s, std::optional<double> delay_ms, bool false_alarm = false) {
  ContactStep s;
  s.approach_speed_m_s = speed_m_s;
  s.delay_ms = delay_ms;
  s.false_alarm = false_alarm;
  return s;
}

const ReportRow& row(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& r : rows) {
    if (r.name == "estimator.contact." + name) return r;
  }
  throw std::invalid_argument(name);
}

TEST(ContactRowsTest, AreByClassOfApproach) {
  std::vector<ContactStep> steps{step(1.5, 2.0), step(1.5, 4.0), step(1.5, 9.0), step(0.5, 8.0),
                                 step(0.2, std::nullopt)};
  steps.emplace_back();  // no floor
  const std::vector<ReportRow> rows = contact_rows(steps);
  EXPECT_DOUBLE_EQ(row(rows, "found").value, 80.0);
  EXPECT_FALSE(row(rows, "found").ok());
  EXPECT_DOUBLE_EQ(row(rows, "delay_median_fast").value, 4.0);
  EXPECT_TRUE(row(rows, "delay_median_fast").ok());
  EXPECT_DOUBLE_EQ(row(rows, "delay_median_medium").value, 8.0);
  EXPECT_TRUE(std::isnan(row(rows, "delay_median_slow").value));
  EXPECT_FALSE(row(rows, "delay_median_slow").ok());
  EXPECT_DOUBLE_EQ(row(rows, "false_alarms").value, 0.0);
}

TEST(ContactRowsTest, FalseAlarmsCountAgainstAllSteps) {
  std::vector<ContactStep> steps(199);
  steps.push_back(step(0.5, std::nullopt, true));
  EXPECT_DOUBLE_EQ(row(contact_rows(steps), "false_alarms").value, 0.5);
  EXPECT_TRUE(row(contact_rows(steps), "false_alarms").ok());
  steps.front().false_alarm = true;
  EXPECT_FALSE(row(contact_rows(steps), "false_alarms").ok());
}

TEST(ContactExperimentTest, SuspendedLegStepsTheSameEveryTime) {
  const RobotConfig robot = load_robot("single_leg");
  SimOptions sim;
  sim.seed = 2;
  const std::vector<ContactStep> steps = stepping_contacts(robot, "best", sim, 6);
  ASSERT_EQ(steps.size(), 6u);
  const std::vector<ContactStep> again = stepping_contacts(robot, "best", sim, 6);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    EXPECT_EQ(steps[i].approach_speed_m_s, again[i].approach_speed_m_s);
    EXPECT_EQ(steps[i].delay_ms, again[i].delay_ms);
  }
}

TEST(ContactExperimentTest, EveryModeJumpsOnce) {
  const std::vector<ContactStep> steps = jump_contacts(load_robot("single_leg"), "best", SimOptions{});
  ASSERT_EQ(steps.size(), 3u);
  for (const ContactStep& s : steps) {
    ASSERT_TRUE(s.approach_speed_m_s);
    EXPECT_EQ(approach_class(*s.approach_speed_m_s), ApproachClass::kFast);
  }
}

}  // namespace
}  // namespace sprung
