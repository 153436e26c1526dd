#include "estimator/identification/fit_problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/estimator/identification/identification_fixture.h"

namespace sprung::identification {
namespace {

using testing::ElementsAre;

/// Memory: every prediction is the number of samples that this piece has shown so far.
class CountingModel : public FitModel {
 public:
  std::string name() const override { return "counting"; }
  const std::vector<FitParameter>& parameters() const override { return parameters_; }
  void predict(const JointDataset& data, const Eigen::VectorXd& parameters, Eigen::VectorXd& prediction,
               Eigen::MatrixXd* jacobian) const override {
    prediction = parameters[0] *
                 Eigen::VectorXd::LinSpaced(data.size(), 1.0, static_cast<double>(data.size()));
    if (jacobian != nullptr) *jacobian = prediction / parameters[0];
  }

 private:
  std::vector<FitParameter> parameters_{{"step", "Nm", 1.0}};
};

std::vector<FitPiece> two_pieces() {
  FitPiece first = whole(swinging_joint(6));
  first.weight << 1, 0, 2, 1, 0, 1;
  FitPiece second = whole(swinging_joint(3));
  second.data.measured_torque.setConstant(10.0);
  return {first, second};
}

TEST(FitProblem, SamplesWithoutWeightDriveTheMemoryAndDoNotCount) {
  const CountingModel model;
  const auto pieces = two_pieces();
  const FitProblem problem(model, pieces);
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  problem.evaluate(Eigen::VectorXd::Constant(1, 2.0), residual, &jacobian);
  EXPECT_THAT(std::vector<double>(residual.begin(), residual.end()), ElementsAre(2, 6, 8, 12, -8, -6, -4));
  EXPECT_EQ(jacobian.rows(), 7);
  EXPECT_EQ(jacobian(3, 0), 6.0);
  EXPECT_THAT(std::vector<double>(problem.weight().begin(), problem.weight().end()),
              ElementsAre(1, 2, 1, 1, 1, 1, 1));
}

TEST(FitProblem, StretchesEndAtGapsAndAtPieces) {
  const CountingModel model;
  const auto pieces = two_pieces();
  EXPECT_THAT(FitProblem(model, pieces).stretches(), ElementsAre(0, 1, 3, 4, 7));
}

TEST(FitProblem, NothingThatCountsIsRefused) {
  const CountingModel model;
  auto pieces = two_pieces();
  for (FitPiece& piece : pieces) piece.weight.setZero();
  EXPECT_THROW(FitProblem(model, pieces), std::invalid_argument);
}

TEST(FitProblem, WrongWeightsAndMixedUnitsAreRefused) {
  const CountingModel model;
  auto pieces = two_pieces();
  pieces[1].weight.resize(2);
  EXPECT_THROW(FitProblem(model, pieces), std::invalid_argument);
  pieces = two_pieces();
  pieces[0].weight[2] = -1.0;
  EXPECT_THROW(FitProblem(model, pieces), std::invalid_argument);
  pieces = two_pieces();
  pieces[1].data.torque_unit = "A";
  EXPECT_THROW(FitProblem(model, pieces), std::invalid_argument);
}

}  // namespace
}  // namespace sprung::identification
