#include "estimator/identification/footprint.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "estimator/identification/least_squares.h"
#include "identification_fixture.h"

namespace sprung::identification {
namespace {

using Index = Eigen::Index;

/// Two turns of the link under a load that is not a function of its position.
JointDataset turning_joint() {
  constexpr Index kSamples = 4000;
  JointDataset data = swinging_joint(kSamples);
  data.gear_ratio = 50.0;
  data.link_position_rad = Eigen::VectorXd::LinSpaced(kSamples, -6.0, 6.0);
  data.load_Nm = 30.0 * (0.9 * data.time_s.array()).sin();
  data.position_rad = data.link_position_rad;
  return data;
}

Eigen::VectorXd truth_of(const FootprintModel& model) {
  Eigen::VectorXd out(static_cast<Index>(model.parameters().size()));
  for (Index i = 0; i < out.size(); ++i) out[i] = 1e-4 * (1.0 + noise(5, i));
  if (model.parameters().back().name == "compliance") out[out.size() - 1] = 1.0 / 2.5e4;
  return out;
}

/// The encoders' difference that the model says. It depends on the motor's angle itself, so it is worked out
/// in rounds.
JointDataset simulated_encoders(const FootprintModel& model, const Eigen::VectorXd& truth, double noise_rad) {
  JointDataset data = turning_joint();
  Eigen::VectorXd difference;
  for (int round = 0; round < 50; ++round) {
    model.predict(data, truth, difference, nullptr);
    data.position_rad = data.link_position_rad + difference;
  }
  for (Index i = 0; i < data.size(); ++i) data.position_rad[i] += noise_rad * noise(9, i);
  return data;
}

TEST(Footprint, DerivativesAreThoseOfThePrediction) {
  const FootprintModel model({});
  const JointDataset data = turning_joint();
  const Eigen::VectorXd at = truth_of(model);
  Eigen::VectorXd here, there;
  Eigen::MatrixXd jacobian;
  model.predict(data, at, here, &jacobian);
  for (Index k = 0; k < at.size(); ++k) {
    Eigen::VectorXd changed = at;
    changed[k] += 1e-3;
    model.predict(data, changed, there, nullptr);
    EXPECT_TRUE(((there - here) / 1e-3).isApprox(jacobian.col(k), 1e-8)) << k;  // linear: exact
  }
}

TEST(Footprint, OneHarmonicInClosedForm) {
  FootprintTerms terms;
  terms.motor_harmonics = {2};
  terms.link_harmonics = {};
  const FootprintModel model(terms);
  JointDataset data = turning_joint();
  Eigen::VectorXd prediction;
  model.predict(data, Eigen::Vector4d(1e-3, 2e-4, -3e-4, 4e-5), prediction, nullptr);
  const double angle = 2.0 * 50.0 * data.position_rad[123];
  EXPECT_NEAR(prediction[123],
              1e-3 + 2e-4 * std::cos(angle) - 3e-4 * std::sin(angle) + 4e-5 * data.load_Nm[123], 1e-15);
}

TEST(Footprint, FitFindsAmplitudesAndStiffness) {
  const FootprintModel model({});
  const Eigen::VectorXd truth = truth_of(model);
  const JointDataset data = encoder_difference(simulated_encoders(model, truth, 2e-5));
  const std::vector<FitPiece> pieces = {whole(data)};
  const Fit found = fit(FitProblem(model, pieces), FitOptions{});
  EXPECT_NEAR(model.stiffness_Nm_rad(found.parameters), 2.5e4, 0.01 * 2.5e4);
  for (Index i = 0; i + 1 < truth.size(); ++i)
    EXPECT_NEAR(found.parameters[i], truth[i], 3e-6) << model.parameters()[i].name;
}

TEST(Footprint, TorqueFromEncodersAloneInvertsThePrediction) {
  FootprintTerms staged;
  staged.spring = TorsionSpring({{0.0, 31e3}, {14.0, 50e3}});
  for (const FootprintModel& model : {FootprintModel({}), FootprintModel(staged)}) {
    const Eigen::VectorXd truth = truth_of(model);
    JointDataset data = simulated_encoders(model, truth, 0.0);
    const Eigen::VectorXd load_Nm = data.load_Nm;
    data.load_Nm.resize(0);
    EXPECT_LT((model.torque_Nm(data, truth) - load_Nm).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(Footprint, LeftInItIsATorqueThatIsNotThere) {
  FootprintTerms none;
  none.motor_harmonics = none.link_harmonics = {};
  const FootprintModel with({}), without(none);
  const Eigen::VectorXd truth = truth_of(with);
  const JointDataset data = simulated_encoders(with, truth, 0.0);
  const Eigen::VectorXd blind = without.torque_Nm(data, Eigen::Vector2d(truth[0], truth[truth.size() - 1]));
  EXPECT_GT((blind - data.load_Nm).cwiseAbs().maxCoeff(), 5.0);
  EXPECT_EQ(with.name(), "footprint");
  EXPECT_EQ(without.name(), "torsion");
}

TEST(Footprint, StiffnessOfTheDataSheetIsItsFirstStages) {
  FootprintTerms staged;
  staged.spring = TorsionSpring({{0.0, 31e3}, {14.0, 50e3}});
  const FootprintModel model(staged);
  EXPECT_NEAR(model.stiffness_Nm_rad(truth_of(model)), 31e3, 1e-6);
}

TEST(Footprint, NeedsLinkEncoderAndLoad) {
  JointDataset data = turning_joint();
  data.load_Nm.resize(0);
  EXPECT_THROW(encoder_difference(data), std::invalid_argument);
  data = turning_joint();
  data.link_position_rad.resize(0);
  EXPECT_THROW(encoder_difference(data), std::invalid_argument);
}

}  // namespace
}  // namespace sprung::identification
