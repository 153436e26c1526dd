#include "tools/lab/estimation/contact_experiment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"
#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/run/scripted_run.h"

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

/// As `sprung identify` would have found sim.yaml's joints, an armature 1 % off included: what these tests
/// ask of contact and bounds is asked of a robot that is identified.
RobotConfig identified_leg() {
  RobotConfig robot = load_robot("single_leg");
  for (JointConfig& joint : robot.joints) {
    IdentifiedFriction friction;
    friction.parameters.coulomb_Nm = 7.25;
    joint.friction = friction;
    joint.armature_kg_m2 = 0.80;
    joint.uncertainty = JointUncertainty{};
    joint.uncertainty.armature = 0.02;
  }
  return robot;
}

/// Plants of the declared box, four of its corners (half of the full design) and four inside, on soft and
/// hard ground; not those on which the detector was tuned.
std::vector<SimOptions> drawn_plants() {
  const auto plant = [](std::uint64_t seed, double friction, double torque_constant, double mass,
                        double ground_N_m) {
    SimOptions sim;
    sim.seed = seed;
    sim.plant = {{"friction_scale", friction},
                 {"kt_scale", torque_constant},
                 {"mass_scale", mass},
                 {"ground_stiffness", ground_N_m},
                 {"sync_jitter_us", 2.0}};
    return sim;
  };
  return {plant(9001, 1.2, 0.96, 1.08, 8000.0),  plant(9002, 0.8, 1.03, 0.93, 60000.0),
          plant(9003, 1.05, 1.0, 1.0, 15000.0),  plant(9004, 0.9, 0.98, 1.05, 30000.0),
          plant(9005, 0.75, 0.95, 0.9, 30000.0), plant(9006, 1.25, 1.05, 0.9, 8000.0),
          plant(9007, 1.25, 0.95, 1.1, 60000.0), plant(9008, 0.75, 1.05, 1.1, 15000.0)};
}

TEST(ContactExperimentTest, IdentifiedLegFindsEveryContactInTimeAndInventsNone) {
  ContactRequest request;
  request.plants = drawn_plants();
  request.steps_per_plant = 10;
  for (const ReportRow& r : contact_rows(run_contacts(identified_leg(), request)))
    EXPECT_TRUE(r.ok()) << r.name << " " << r.value;
}

/// How many of an estimate's samples were within their bound.
struct Coverage {
  long inside = 0, all = 0;
  void add(double error, double bound) {
    if (!std::isfinite(error)) return;
    ++all;
    inside += std::abs(error) <= bound ? 1 : 0;
  }
  double percent() const { return 100.0 * static_cast<double>(inside) / static_cast<double>(all); }
};

TEST(ContactExperimentTest, BoundsOfExternalTorqueAndFootForceHoldAtTheirProbability) {
  const RobotConfig robot = identified_leg();
  const auto leg = make_leg_kinematics(robot.legs[0]);
  Coverage torque, force_x, force_z;
  const auto compare = [&](const JointState& in, const SimTruth& truth) {
    const Eigen::Vector3d force_N = to_eigen(truth.legs[0].true_contact_force_N);
    JointVector q(2);
    q << truth.joints[0].true_position_rad, truth.joints[1].true_position_rad;
    const JointVector external_Nm = leg->jacobian(q).transpose() * force_N;
    for (int j = 0; j < 2; ++j) {
      const EstimatedJoint& joint = in.joints[j];
      torque.add(joint.external_torque_Nm - external_Nm[j], joint.external_torque_bound_Nm);
    }
    const EstimatedLeg& out = in.legs[0];
    force_x.add(out.foot_force_N[0] - force_N.x(), out.foot_force_bound_N[0]);
    force_z.add(out.foot_force_N[2] - force_N.z(), out.foot_force_bound_N[2]);
  };
  for (const SimOptions& sim : drawn_plants()) {
    run_in_process(
        jump_script(robot, "best", sim, JumpMode::kHybrid, 1),
        [&](const CycleRecord& cycle) { compare(cycle.joint_state, cycle.truth); },
        [](const OperatorReply&) {});
    run_stepping(robot, "best", sim, 6,
                 [&](const JointState& in, const SimTruth& truth, bool) { compare(in, truth); });
  }
  for (const Coverage* coverage : {&torque, &force_x, &force_z}) {
    EXPECT_GE(coverage->percent(), 93.0);
    EXPECT_LE(coverage->percent(), 98.5);
  }
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
