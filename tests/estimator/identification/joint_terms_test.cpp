#include "estimator/identification/joint_terms.h"

#include <gtest/gtest.h>

#include "identification_fixture.h"

namespace sprung::identification {
namespace {

TEST(JointTerms, NamesTellWhatAModelHas) {
  EXPECT_EQ(name(JointTerms{}), "coulomb");
  EXPECT_EQ(name(JointTerms{JointTerm::kViscous, JointTerm::kLoad, JointTerm::kRipple2}),
            "viscous+load+ripple_2");
}

TEST(JointTerms, EveryTermHasItsOwnName) {
  JointDataset data = swinging_joint(10);
  data.load_Nm = data.temperature_C = Eigen::VectorXd::Zero(10);
  std::vector<std::string> names;
  for (const JointTerm term : possible_terms(data)) {
    EXPECT_EQ(std::count(names.begin(), names.end(), name(term)), 0) << name(term);
    names.emplace_back(name(term));
  }
  EXPECT_EQ(names.size(), 11u);
}

TEST(JointTerms, NeedTheSignalsThatTheyAreMadeOf) {
  JointDataset data = swinging_joint(10);
  EXPECT_FALSE(has(possible_terms(data), JointTerm::kTemperature));
  EXPECT_FALSE(has(possible_terms(data), JointTerm::kLoadGain));
  data.load_Nm = Eigen::VectorXd::Zero(10);
  EXPECT_TRUE(has(possible_terms(data), JointTerm::kLoadGain));
  data.temperature_C = Eigen::VectorXd::Zero(10);
  EXPECT_TRUE(has(possible_terms(data), JointTerm::kTemperature));
}

TEST(JointTerms, WhatShapesViscousFrictionFollowsIt) {
  EXPECT_FALSE(can_follow({}, JointTerm::kShear));
  EXPECT_FALSE(can_follow({JointTerm::kStribeck}, JointTerm::kTemperature));
  EXPECT_TRUE(can_follow({JointTerm::kViscous}, JointTerm::kShear));
  EXPECT_FALSE(can_follow({JointTerm::kViscous}, JointTerm::kViscous)) << "a term stands once";
}

TEST(JointTerms, BringParametersOfTheFrictionLaw) {
  using P = FrictionParameter;
  EXPECT_EQ(friction_of({}), std::vector<P>{P::kCoulomb});
  EXPECT_EQ(friction_of({JointTerm::kStribeck, JointTerm::kRipple1}),
            (std::vector<P>{P::kCoulomb, P::kStribeck, P::kStribeckSpeed}));
}

TEST(JointTerms, HarmonicsAscend) {
  EXPECT_EQ(ripple_harmonics({JointTerm::kRipple4, JointTerm::kViscous, JointTerm::kRipple1}),
            (std::vector<int>{1, 4}));
}

}  // namespace
}  // namespace sprung::identification
