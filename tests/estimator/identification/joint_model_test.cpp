#include "estimator/identification/joint_model.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "estimator/identification/least_squares.h"
#include "identification_fixture.h"

namespace sprung::identification {
namespace {

using Index = Eigen::Index;

/// A joint of which everything is known, so that every term is possible.
JointDataset full_dataset(Index samples) {
  JointDataset data = swinging_joint(samples);
  data.gear_ratio = 50.0;
  data.load_Nm = (1.3 * data.time_s.array()).sin() * 20.0;
  data.temperature_C = 24.0 + data.time_s.array();
  return data;
}

/// swinging_joint with torques of a few Nm: starts are scaled by them.
JointDataset moved_joint(Index samples) {
  JointDataset data = swinging_joint(samples);
  data.measured_torque = 5.0 * data.velocity_rad_s;
  return data;
}

Eigen::VectorXd initial(const FitModel& model) {
  Eigen::VectorXd out(static_cast<Index>(model.parameters().size()));
  for (Index i = 0; i < out.size(); ++i) out[i] = model.parameters()[i].initial;
  return out;
}

Index index_of(const FitModel& model, const std::string& name) {
  for (std::size_t i = 0; i < model.parameters().size(); ++i) {
    if (model.parameters()[i].name == name) return static_cast<Index>(i);
  }
  throw std::out_of_range(name);
}

/// Parameters by name, all others off: friction at the law's plain values, the rest zero.
Eigen::VectorXd with(const FitModel& model, const std::vector<std::pair<std::string, double>>& values) {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Index>(model.parameters().size()));
  for (const auto& [name, value] : values) out[index_of(model, name)] = value;
  return out;
}

void expect_derivatives(const JointModel& model, const JointDataset& data, const Eigen::VectorXd& at) {
  Eigen::VectorXd here, above, below;
  Eigen::MatrixXd jacobian;
  model.predict(data, at, here, &jacobian);
  for (Index k = 0; k < at.size(); ++k) {
    const double step = 1e-6 * std::max(1e-3, std::abs(at[k]));
    Eigen::VectorXd changed = at;
    changed[k] = at[k] + step;
    model.predict(data, changed, above, nullptr);
    changed[k] = at[k] - step;
    model.predict(data, changed, below, nullptr);
    const Eigen::VectorXd slope = (above - below) / (2.0 * step);
    const double scale = std::max(1.0, slope.cwiseAbs().maxCoeff());
    // Elements of the presliding state that begin to slip within the step may differ: single samples.
    const Index wrong = ((jacobian.col(k) - slope).array().abs() > 1e-5 * scale).count();
    EXPECT_LE(wrong, data.size() / 100) << model.name() << ", " << model.parameters()[k].name;
  }
}

TEST(JointModel, DerivativesWithAWeightBesideItsOwnAreThoseOfThePrediction) {
  JointDataset data = full_dataset(400);
  data.load_beside_own = true;
  const JointModel model({JointTerm::kViscous, JointTerm::kLoad, JointTerm::kLoadGain}, data);
  Eigen::VectorXd at = initial(model);
  for (Index i = 0; i < at.size(); ++i) at[i] += 0.01 * (1.0 + noise(4, i)) * std::max(0.1, std::abs(at[i]));
  at[index_of(model, "coulomb")] = 2.0;
  expect_derivatives(model, data, at);
}

TEST(JointModel, KnownWeightTellsLoadFrictionAndTorqueConstantBesideTheJointsOwnWeight) {
  JointDataset data = full_dataset(3000);
  data.load_beside_own = true;
  const JointModel model({JointTerm::kViscous, JointTerm::kLoad, JointTerm::kLoadGain}, data);
  const Eigen::VectorXd truth = with(model, {{"inertia", 0.8},
                                             {"gravity_cos", 3.0},
                                             {"gravity_sin", -1.0},
                                             {"load_gain", 1.05},
                                             {"coulomb", 5.0},
                                             {"viscous", 7.0},
                                             {"load_share_driving", 0.15},
                                             {"load_share_driven", 0.15}});
  data = simulated(model, truth, data, 0.3, 5);
  const Fit found = fit(FitProblem(model, {whole(data)}), {});
  EXPECT_NEAR(found.parameters[index_of(model, "load_gain")], 1.05, 0.01);
  EXPECT_NEAR(found.parameters[index_of(model, "load_share_driving")], 0.15, 0.015);
  EXPECT_NEAR(found.parameters[index_of(model, "load_share_driven")], 0.15, 0.015);
  EXPECT_NEAR(found.parameters[index_of(model, "gravity_cos")], 3.0, 0.1);
  EXPECT_NEAR(found.parameters[index_of(model, "coulomb")], 5.0, 0.15);
}

TEST(JointModel, DerivativesAreThoseOfThePrediction) {
  const JointDataset data = full_dataset(400);
  JointTerms all = possible_terms(data);
  const JointModel model(all, data);
  Eigen::VectorXd at = initial(model);
  for (Index i = 0; i < at.size(); ++i) at[i] += 0.01 * (1.0 + noise(3, i)) * std::max(0.1, std::abs(at[i]));
  at[index_of(model, "presliding")] = 0.01;
  at[index_of(model, "coulomb")] = 2.0;
  expect_derivatives(model, data, at);
}

TEST(JointModel, DerivativesByGravityHoldTheLoadsFriction) {
  const JointDataset data = moved_joint(400);
  const JointModel model({JointTerm::kViscous, JointTerm::kLoad, JointTerm::kAsymmetry}, data);
  Eigen::VectorXd at = initial(model);
  at[index_of(model, "gravity_cos")] = -7.0;
  at[index_of(model, "gravity_sin")] = 3.0;
  at[index_of(model, "load_share_driven")] = 0.2;
  expect_derivatives(model, data, at);
}

TEST(JointModel, RigidBodyInClosedForm) {
  const JointDataset data = moved_joint(100);
  const JointModel model({}, data);
  const Eigen::VectorXd at = with(
      model, {{"inertia", 0.8}, {"gravity_cos", 3.0}, {"gravity_sin", -2.0}, {"offset", 0.1}});
  Eigen::VectorXd prediction;
  model.predict(data, at, prediction, nullptr);
  for (const Index i : {0, 40, 99}) {
    const double q = data.position_rad[i];
    EXPECT_NEAR(prediction[i],
                0.8 * data.acceleration_rad_s2[i] + 3.0 * std::cos(q) - 2.0 * std::sin(q) + 0.1, 1e-12);
  }
}

TEST(JointModel, FrictionGrowsWithTheLoadByTheShareOfItsDirection) {
  JointDataset data = moved_joint(3);
  data.velocity_rad_s << 1.0, 1.0, -1.0;  // a hundred times what smooths the sign: tanh is 1
  data.acceleration_rad_s2.setZero();
  data.load_Nm = Eigen::Vector3d(10.0, -10.0, -10.0);
  const JointModel model({JointTerm::kLoad}, data);
  Eigen::VectorXd prediction;
  model.predict(data, with(model, {{"load_share_driving", 0.2}, {"load_share_driven", 0.1}}), prediction,
                nullptr);
  EXPECT_NEAR(prediction[0], 10.0 + 2.0, 1e-9) << "the motor drives";
  EXPECT_NEAR(prediction[1], -10.0 + 1.0, 1e-9) << "the load drives";
  EXPECT_NEAR(prediction[2], -10.0 - 2.0, 1e-9);
}

TEST(JointModel, RippleTurnsWithTheMotor) {
  JointDataset data = moved_joint(4);
  data.gear_ratio = 100.0;
  data.velocity_rad_s.setZero();
  data.acceleration_rad_s2.setZero();
  data.position_rad = Eigen::Vector4d(0.0, M_PI / 4.0, M_PI / 2.0, 3.0 * M_PI / 4.0) /
                      100.0;  // of the motor: eighths
  const JointModel model({JointTerm::kRipple2}, data);
  Eigen::VectorXd prediction;
  model.predict(data, with(model, {{"ripple_2_cos", 2.0}, {"ripple_2_sin", 0.5}}), prediction, nullptr);
  EXPECT_TRUE(prediction.isApprox(Eigen::Vector4d(2.0, 0.5, -2.0, -0.5), 1e-12)) << prediction.transpose();
}

TEST(JointModel, PreslidingRoundsTheReversal) {
  JointDataset data = moved_joint(3);
  data.velocity_rad_s.setZero();
  data.acceleration_rad_s2.setZero();
  data.position_rad = Eigen::Vector3d(0.0, 1.0, 1.0 - 1e-4);
  const JointModel model({JointTerm::kPresliding}, data);
  Eigen::VectorXd prediction;
  model.predict(data, with(model, {{"coulomb", 4.0}, {"presliding", 1e-3}}), prediction, nullptr);
  EXPECT_NEAR(prediction[0], 0.0, 1e-12) << "before the first motion";
  EXPECT_NEAR(prediction[1], 4.0, 1e-12);
  EXPECT_NEAR(prediction[2], 4.0 - 4.0 * 0.1, 1e-9) << "first stiffness: full friction within `presliding`";
}

TEST(JointModel, RefusesTermsThatCannotBe) {
  const JointDataset data = moved_joint(10);
  EXPECT_THROW(JointModel({JointTerm::kShear}, data), std::invalid_argument);
  EXPECT_THROW(JointModel({JointTerm::kLoadGain}, data), std::invalid_argument);
  EXPECT_THROW(JointModel({JointTerm::kLoad, JointTerm::kLoad}, data), std::invalid_argument);
}

TEST(JointModel, GearOutputInvertsThePrediction) {
  JointDataset data = full_dataset(300);
  const JointModel model({JointTerm::kViscous, JointTerm::kLoad, JointTerm::kPresliding, JointTerm::kRipple2},
                         data);
  const Eigen::VectorXd at = with(model, {{"inertia", 0.6},
                                          {"offset", 0.2},
                                          {"coulomb", 3.0},
                                          {"viscous", 2.0},
                                          {"load_share_driving", 0.15},
                                          {"load_share_driven", 0.08},
                                          {"presliding", 1e-3},
                                          {"ripple_2_cos", 0.4}});
  model.predict(data, at, data.measured_torque, nullptr);
  EXPECT_TRUE(model.gear_output(data, at).isApprox(data.load_Nm, 1e-9));
}

TEST(JointModel, FitFindsTheTruthInNoise) {
  JointDataset data = moved_joint(4000);
  const JointModel model({JointTerm::kViscous, JointTerm::kLoad, JointTerm::kPresliding}, data);
  const Eigen::VectorXd truth = with(model, {{"inertia", 0.7},
                                             {"gravity_cos", 4.0},
                                             {"gravity_sin", 15.0},
                                             {"offset", -0.3},
                                             {"coulomb", 3.0},
                                             {"viscous", 1.5},
                                             {"load_share_driving", 0.15},
                                             {"load_share_driven", 0.06},
                                             {"presliding", 8e-4}});
  data = simulated(model, truth, data, 0.2, 11);
  const std::vector<FitPiece> pieces = {whole(data)};
  const Fit found = fit(FitProblem(JointModel(model.terms(), data), pieces), FitOptions{});
  for (Index i = 0; i < truth.size(); ++i)
    EXPECT_NEAR(found.parameters[i], truth[i], 0.05 * std::max(0.2, std::abs(truth[i])))
        << model.parameters()[i].name;
}

}  // namespace
}  // namespace sprung::identification
