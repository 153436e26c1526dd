#include "tools/lab/friction/friction_sweep_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using T = identification::JointTerm;

const identification::JointTerms kEverything = {T::kViscous, T::kStribeck, T::kLoad, T::kAsymmetry};

/// Positions, speeds and loads of both signs.
identification::JointDataset sweep() {
  identification::JointDataset data;
  const Index n = 24;
  for (VectorXd* v : {&data.time_s, &data.position_rad, &data.velocity_rad_s, &data.acceleration_rad_s2,
                      &data.measured_torque, &data.load_Nm})
    *v = VectorXd::Zero(n);
  for (Index i = 0; i < n; ++i) {
    data.position_rad[i] = 0.1 * static_cast<double>(i) - 1.0;
    data.velocity_rad_s[i] = (i % 2 == 0 ? 1.0 : -1.0) * (0.05 + 0.1 * static_cast<double>(i));
    data.load_Nm[i] = static_cast<double>(i % 5) * 5.0 - 10.0;
    data.measured_torque[i] = 5.0;
  }
  return data;
}

VectorXd values(const SweepModel& model) {
  VectorXd out(static_cast<Index>(model.parameters().size()));
  for (std::size_t i = 0; i < model.parameters().size(); ++i) {
    const std::string& name = model.parameters()[i].name;
    out[static_cast<Index>(i)] = name == "gravity_cos"          ? 1.5
                                 : name == "gravity_sin"        ? -2.5
                                 : name == "coulomb"            ? 4.0
                                 : name == "stribeck"           ? 1.0
                                 : name == "stribeck_speed"     ? 0.2
                                 : name == "viscous"            ? 1.3
                                 : name == "load_share_driving" ? 0.06
                                 : name == "load_share_driven"  ? 0.09
                                                                : 0.05;
  }
  return out;
}

TEST(FrictionSweepModel, ConstantSpeedTakesLoadWeightAndFrictionAndNothingElse) {
  const identification::JointDataset data = sweep();
  const SweepModel model({T::kViscous}, true, {});
  ASSERT_EQ(model.parameters().size(), 4u);
  VectorXd parameters(4), prediction;
  parameters << 1.5, -2.5, 4.0, 1.3;
  model.predict(data, parameters, prediction, nullptr);
  for (Index i = 0; i < data.size(); ++i) {
    const double w = data.velocity_rad_s[i];
    const double expected = data.load_Nm[i] + 1.5 * std::cos(data.position_rad[i]) -
                            2.5 * std::sin(data.position_rad[i]) + std::copysign(4.0, w) + 1.3 * w;
    EXPECT_NEAR(prediction[i], expected, 1e-12) << i;
  }
}

TEST(FrictionSweepModel, WeightCountsAsLoadOfTheGear) {
  identification::JointDataset data = sweep();
  const SweepModel with_weight({T::kLoad}, true, {});
  const SweepModel without({T::kLoad}, false, {});
  VectorXd parameters = values(with_weight), with, known;
  with_weight.predict(data, parameters, with, nullptr);
  data.load_Nm = with_weight.load_Nm(data, parameters);
  without.predict(data, parameters.tail(parameters.size() - 2), known, nullptr);
  EXPECT_LT((with - known).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(FrictionSweepModel, DerivativesAgreeWithDifferences) {
  const identification::JointDataset data = sweep();
  for (const bool own_weight : {false, true}) {
    const SweepModel model(kEverything, own_weight, {});
    const VectorXd at = values(model);
    VectorXd prediction;
    Eigen::MatrixXd jacobian;
    model.predict(data, at, prediction, &jacobian);
    ASSERT_EQ(jacobian.cols(), at.size());
    for (Index k = 0; k < at.size(); ++k) {
      const double step = 1e-6;
      VectorXd less = at, more = at, low, high;
      less[k] -= step;
      more[k] += step;
      model.predict(data, less, low, nullptr);
      model.predict(data, more, high, nullptr);
      const VectorXd slope = (high - low) / (2.0 * step);
      EXPECT_LT((slope - jacobian.col(k)).cwiseAbs().maxCoeff(), 1e-6) << model.parameters()[k].name;
    }
  }
}

TEST(FrictionSweepModel, StartsLieWithinTheirBounds) {
  const SweepModel model(kEverything, true, {});
  for (const identification::FitParameter& p : model.parameters()) {
    EXPECT_LE(p.lower, p.initial) << p.name;
    EXPECT_GE(p.upper, p.initial) << p.name;
  }
}

}  // namespace
}  // namespace sprung
