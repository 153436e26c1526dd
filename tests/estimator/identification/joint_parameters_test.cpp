#include "estimator/identification/joint_parameters.h"

#include <gtest/gtest.h>

#include <map>

#include "identification_fixture.h"

namespace sprung::identification {
namespace {

JointDataset moved_joint() {
  JointDataset data = swinging_joint(200);
  data.measured_torque = 5.0 * data.velocity_rad_s;
  return data;
}

JointDataset full_dataset() {
  JointDataset data = moved_joint();
  data.load_Nm = Eigen::VectorXd::Ones(data.size());
  data.temperature_C = Eigen::VectorXd::Constant(data.size(), 30.0);
  return data;
}

std::vector<std::string> names(const JointTerms& terms, const JointDataset& data) {
  std::vector<std::string> out;
  for (const FitParameter& p : joint_parameters(terms, data)) out.push_back(p.name);
  return out;
}

using Names = std::vector<std::string>;

TEST(JointParameters, StandInTheOrderThatTheModelReadsThem) {
  const JointDataset data = moved_joint();
  EXPECT_EQ(names({}, data), (Names{"inertia", "gravity_cos", "gravity_sin", "offset", "coulomb"}));
  EXPECT_EQ(names({JointTerm::kRipple2, JointTerm::kRipple1}, data),
            (Names{"inertia", "gravity_cos", "gravity_sin", "offset", "coulomb", "ripple_1_cos",
                   "ripple_1_sin", "ripple_2_cos", "ripple_2_sin"}));
}

TEST(JointParameters, AKnownLoadStandsForGravity) {
  EXPECT_EQ(names({JointTerm::kViscous}, full_dataset()), (Names{"inertia", "offset", "coulomb", "viscous"}));
  EXPECT_EQ(names({JointTerm::kLoadGain}, full_dataset()),
            (Names{"inertia", "load_gain", "offset", "coulomb"}));
}

TEST(JointParameters, UnitsFollowTheMeasuredTorque) {
  JointDataset data = full_dataset();
  const JointTerms terms = {JointTerm::kViscous, JointTerm::kLoadGain, JointTerm::kRipple1};
  const auto units = [&] {
    std::map<std::string, std::string> out;
    for (const FitParameter& p : joint_parameters(terms, data)) out[p.name] = p.unit;
    return out;
  };
  EXPECT_EQ(units()["inertia"], "kg m^2");
  EXPECT_EQ(units()["load_gain"], "");
  EXPECT_EQ(units()["viscous"], "Nm s/rad");
  data.torque_unit = "A";
  EXPECT_EQ(units()["inertia"], "A s^2/rad");
  EXPECT_EQ(units()["load_gain"], "A/Nm");
  EXPECT_EQ(units()["coulomb"], "A");
  EXPECT_EQ(units()["viscous"], "A s/rad");
  EXPECT_EQ(units()["ripple_1_sin"], "A");
}

TEST(JointParameters, StartsLieWithinTheirBounds) {
  for (const FitParameter& p : joint_parameters(possible_terms(full_dataset()), full_dataset())) {
    EXPECT_LE(p.lower, p.initial) << p.name;
    EXPECT_LE(p.initial, p.upper) << p.name;
    for (const double start : p.more_starts) EXPECT_TRUE(p.lower <= start && start <= p.upper) << p.name;
    EXPECT_FALSE(p.told_by.empty()) << p.name;
  }
}

TEST(JointParameters, NoFitMayEndWhereNoGearIs) {
  std::map<std::string, FitParameter> found;
  for (const FitParameter& p : joint_parameters({JointTerm::kStribeck, JointTerm::kAsymmetry}, moved_joint()))
    found.emplace(p.name, p);
  EXPECT_EQ(found.at("stribeck_speed").lower, 0.03);
  EXPECT_EQ(found.at("asymmetry").lower, -0.2);
  EXPECT_EQ(found.at("asymmetry").upper, 0.2);
}

TEST(JointParameters, StartsGrowWithTheTorque) {
  JointDataset data = moved_joint();
  const double small = joint_parameters({}, data)[4].initial;
  data.measured_torque *= 100.0;
  EXPECT_NEAR(joint_parameters({}, data)[4].initial, 100.0 * small, 1e-9 * small);
}

TEST(JointParameters, AJointThatNeverMovedStillHasStarts) {
  JointDataset data = swinging_joint(10);
  data.velocity_rad_s.setZero();
  for (const FitParameter& p : joint_parameters({JointTerm::kViscous, JointTerm::kStribeck}, data))
    EXPECT_TRUE(std::isfinite(p.initial)) << p.name;
}

}  // namespace
}  // namespace sprung::identification
