#include "estimator/identification/least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "tests/estimator/identification/identification_fixture.h"

namespace sprung::identification {
namespace {

const double kLeastSquaresInf = std::numeric_limits<double>::infinity();

/// torque = a sin(k q) + c: far from the right k the squares have other valleys.
class RippleModel : public FitModel {
 public:
  explicit RippleModel(std::vector<double> more_starts = {}) {
    parameters_ = {{"height", "Nm", 1.0, 0.0, 100.0}, {"waves", "1/rad", 5.0, 1e-3, 100.0}, {"floor", "Nm"}};
    parameters_[1].more_starts = std::move(more_starts);
  }
  std::string name() const override { return "ripple"; }
  const std::vector<FitParameter>& parameters() const override { return parameters_; }
  void predict(const JointDataset& data, const Eigen::VectorXd& x, Eigen::VectorXd& prediction,
               Eigen::MatrixXd* jacobian) const override {
    const Eigen::ArrayXd q = data.position_rad.array();
    prediction = x[0] * (x[1] * q).sin() + x[2];
    if (jacobian == nullptr) return;
    jacobian->resize(data.size(), 3);
    jacobian->col(0) = (x[1] * q).sin();
    jacobian->col(1) = x[0] * q * (x[1] * q).cos();
    jacobian->col(2).setOnes();
  }

 private:
  std::vector<FitParameter> parameters_;
};

Eigen::VectorXd vector(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(), static_cast<Eigen::Index>(values.size()));
}

Fit fitted(const FitModel& model, const JointDataset& data, RobustLoss loss = RobustLoss::kNone) {
  const std::vector<FitPiece> pieces{whole(data)};
  FitOptions options;
  options.loss = loss;
  return fit(FitProblem(model, pieces), options);
}

TEST(LeastSquares, LinearModelGivesTheClosedFormSolution) {
  const LinearModel model = inertia_and_friction();
  const JointDataset data = simulated(model, vector({0.8, 7.0, 2.5, -0.3}), swinging_joint(1400), 0.5, 1);
  Eigen::VectorXd none;
  Eigen::MatrixXd columns;
  model.predict(data, Eigen::VectorXd::Ones(4), none, &columns);
  const Eigen::VectorXd expected = columns.colPivHouseholderQr().solve(data.measured_torque);
  const Fit found = fitted(model, data);
  EXPECT_TRUE(found.converged);
  EXPECT_LT((found.parameters - expected).norm(), 1e-6 * expected.norm());
  EXPECT_EQ(found.at_bound, std::vector<bool>(4, false));
}

TEST(LeastSquares, WeightsCount) {
  const LinearModel model("constant", {{"offset", "Nm"}}, {offset_column});
  FitPiece piece = whole(swinging_joint(3));
  piece.data.measured_torque << 0.0, 3.0, 100.0;
  piece.weight << 1.0, 2.0, 0.0;
  const std::vector<FitPiece> pieces{piece};
  FitOptions options;
  options.loss = RobustLoss::kNone;
  EXPECT_NEAR(fit(FitProblem(model, pieces), options).parameters[0], 2.0, 1e-8);
}

TEST(LeastSquares, ABoundThatActsHoldsAndTheOthersFitAroundIt) {
  LinearModel model("bounded", {{"coulomb", "Nm", 1.0, 0.0}, {"viscous", "Nm s/rad", 1.0, 0.0}},
                    {coulomb_column, viscous_column});
  const LinearModel free("free", {{"coulomb", "Nm"}, {"viscous", "Nm s/rad"}},
                         {coulomb_column, viscous_column});
  const JointDataset data = simulated(free, vector({5.0, -2.0}), swinging_joint(1400), 0.1, 2);
  const Fit found = fitted(model, data);
  EXPECT_NEAR(found.parameters[1], 0.0, 1e-6);
  EXPECT_FALSE(found.at_bound[0]);
  EXPECT_TRUE(found.at_bound[1]);
  const LinearModel alone("alone", {{"coulomb", "Nm"}}, {coulomb_column});
  EXPECT_NEAR(found.parameters[0], fitted(alone, data).parameters[0], 1e-5);
}

TEST(LeastSquares, AStartOnABoundThatDoesNotActIsLeft) {
  for (const double bound_start : {0.0, 50.0}) {
    LinearModel model(
        "bounded", {{"coulomb", "Nm", bound_start, 0.0, 50.0}, {"viscous", "", 0.0, -kLeastSquaresInf, 0.0}},
        {coulomb_column, viscous_column});
    const JointDataset data = simulated(model, vector({5.0, -2.0}), swinging_joint(700), 0.0, 1);
    const Fit found = fitted(model, data);
    EXPECT_NEAR(found.parameters[0], 5.0, 1e-6) << bound_start;
    EXPECT_NEAR(found.parameters[1], -2.0, 1e-6) << bound_start;
  }
}

TEST(LeastSquares, FixedParameterStays) {
  LinearModel model("fixed", {{"coulomb", "Nm", 4.0, 4.0, 4.0}, {"viscous", ""}},
                    {coulomb_column, viscous_column});
  const Fit found = fitted(model, simulated(model, vector({5.0, 2.0}), swinging_joint(700), 0.0, 1));
  EXPECT_EQ(found.parameters[0], 4.0);
  EXPECT_TRUE(found.at_bound[0]);
}

TEST(LeastSquares, RobustLossesResistOutliersThatSpoilTheSquares) {
  const LinearModel model = inertia_and_friction();
  const Eigen::VectorXd truth = vector({0.8, 7.0, 2.5, -0.3});
  JointDataset data = simulated(model, truth, swinging_joint(1400), 0.2, 3);
  for (Eigen::Index i = 0; i < 1400; i += 12) data.measured_torque[i] += 60.0;  // 8 %, all to one side
  const auto error = [&](RobustLoss loss) {
    return (fitted(model, data, loss).parameters - truth).cwiseAbs().maxCoeff();
  };
  EXPECT_GT(error(RobustLoss::kNone), 2.0);
  EXPECT_LT(error(RobustLoss::kHuber), 0.15);
  EXPECT_LT(error(RobustLoss::kTukey), 0.05);
}

TEST(LeastSquares, SeveralStartsFindWhatOneMisses) {
  const RippleModel one, many({15.0, 30.0});
  const JointDataset data = simulated(one, vector({6.0, 32.0, 2.0}), swinging_joint(2800), 0.05, 4);
  const Fit poor = fitted(one, data), good = fitted(many, data);
  EXPECT_EQ(good.starts, 3);
  EXPECT_GT(std::abs(poor.parameters[1] - 32.0), 1.0);
  EXPECT_NEAR(good.parameters[1], 32.0, 0.01);
  EXPECT_LT(good.cost, poor.cost / 100.0);
}

TEST(LeastSquares, CombinationsOfStartsAreLimited) {
  const RippleModel many(std::vector<double>(100, 0.1));
  const std::vector<FitPiece> pieces{whole(swinging_joint(50))};
  FitOptions options;
  options.most_starts = 5;
  EXPECT_EQ(fit(FitProblem(many, pieces), options).starts, 5);
}

TEST(LeastSquares, TheSameDataGiveTheSameBits) {
  const RippleModel model({15.0, 30.0});
  const JointDataset data = simulated(model, vector({6.0, 32.0, 2.0}), swinging_joint(1400), 0.3, 5);
  EXPECT_EQ(fitted(model, data, RobustLoss::kTukey).parameters,
            fitted(model, data, RobustLoss::kTukey).parameters);
}

TEST(LeastSquares, ModelThatIsNotFiniteIsNamed) {
  const LinearModel model("broken", {{"a", ""}}, {[](const JointDataset& data) {
                            return Eigen::VectorXd(Eigen::VectorXd::Constant(data.size(), std::nan("")));
                          }});
  EXPECT_THROW(fitted(model, swinging_joint(10)), std::runtime_error);
}

TEST(LeastSquares, RunningOutOfEvaluationsIsSaid) {
  const RippleModel model;
  const JointDataset data = simulated(model, vector({6.0, 8.0, 2.0}), swinging_joint(700), 0.0, 1);
  const std::vector<FitPiece> pieces{whole(data)};
  FitOptions options;
  options.most_evaluations = 2;
  EXPECT_FALSE(fit_from(FitProblem(model, pieces), vector({1.0, 5.0, 0.0}), options).converged);
}

}  // namespace
}  // namespace sprung::identification
