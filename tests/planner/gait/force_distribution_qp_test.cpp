#include "planner/gait/force_distribution_qp.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace sprung {
namespace {

using Qp = ForceDistributionQp;

struct Problem {
  Qp::Matrix cost = Qp::Matrix::Identity();
  Qp::Vector gradient = Qp::Vector::Zero();
  std::vector<Qp::Row> rows;
};

bool solve(const Problem& problem, Qp& qp) {
  qp.begin(problem.cost, problem.gradient);
  for (const Qp::Row& row : problem.rows) EXPECT_TRUE(qp.add(row));
  return qp.solve();
}

double between(double least, double most, std::mt19937& random) {
  return std::uniform_real_distribution<>(least, most)(random);
}

/// Six wants on twelve numbers, and little that chooses among the rest: as badly conditioned as the real
/// problem (1e5 and more).
Problem random_problem(std::mt19937& random) {
  Problem problem;
  const auto number = [&](double) { return between(-1.0, 1.0, random); };
  const Eigen::Matrix<double, 6, 12> wants = Eigen::Matrix<double, 6, 12>::Zero().unaryExpr(number);
  problem.cost = 10.0 * wants.transpose() * wants + 1e-4 * Qp::Matrix::Identity();
  problem.gradient = 300.0 * wants.transpose() * Eigen::Matrix<double, 6, 1>::Zero().unaryExpr(number);
  for (int i = 0; i < Qp::kMostRows; ++i) {
    const Eigen::Vector3d normal = Eigen::Vector3d::Zero().unaryExpr(number);
    // The origin is always allowed, and a third of the rows meet in it.
    const double least = problem.rows.size() % 3 == 0 ? 0.0 : between(-30.0, 0.0, random);
    problem.rows.push_back({3 * (i % 4), normal, least});
  }
  return problem;
}

double excess(const Qp::Row& row, const Qp::Vector& x) {
  return row.normal.dot(x.segment<3>(row.first)) - row.least;
}

/// Karush, Kuhn and Tucker: for a strictly convex problem necessary and sufficient, so this proves the
/// answer.
void expect_optimal(const Problem& problem, const Qp& qp) {
  const Qp::Vector& x = qp.solution();
  Qp::Vector slope = problem.cost * x + problem.gradient;
  double largest = problem.gradient.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < problem.rows.size(); ++i) {
    const Qp::Row& row = problem.rows[i];
    const double price = qp.price(static_cast<int>(i));
    ASSERT_GE(excess(row, x), -Qp::kTolerance);
    ASSERT_GE(price, 0.0);
    if (price > 0.0) {
      ASSERT_NEAR(excess(row, x), 0.0, 1e-6);
    }
    slope.segment<3>(row.first) -= price * row.normal;
    largest = std::max(largest, price);
  }
  ASSERT_LT(slope.cwiseAbs().maxCoeff(), 1e-9 * (1.0 + largest));
}

TEST(ForceDistributionQp, RandomProblemsMeetTheConditionsOfOptimality) {
  std::mt19937 random(1);
  Qp qp;
  int most_steps = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Problem problem = random_problem(random);
    ASSERT_TRUE(solve(problem, qp)) << trial;
    ASSERT_NO_FATAL_FAILURE(expect_optimal(problem, qp)) << trial;
    most_steps = std::max(most_steps, qp.steps());
  }
  EXPECT_LT(most_steps, Qp::kMostSteps / 2);
  EXPECT_GT(most_steps, 12);
}

/// The minimum on the planes of these rows, all of them of the first foot.
Eigen::Vector3d minimum_on(const Eigen::Matrix3d& cost, const Eigen::Vector3d& gradient,
                           const std::vector<Qp::Row>& rows) {
  const Eigen::Index count = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 + count, 3 + count);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(3 + count);
  all.topLeftCorner<3, 3>() = cost;
  right.head<3>() = -gradient;
  for (Eigen::Index i = 0; i < count; ++i) {
    all.block<3, 1>(0, 3 + i) = rows[i].normal;
    all.block<1, 3>(3 + i, 0) = rows[i].normal.transpose();
    right[3 + i] = rows[i].least;
  }
  return all.fullPivLu().solve(right).head<3>();
}

/// Every set of up to three active rows, tried one after the other.
struct BruteForce {
  Eigen::Matrix3d cost;
  Eigen::Vector3d gradient;
  std::vector<Qp::Row> rows;
  double least = std::numeric_limits<double>::infinity();
  Eigen::Vector3d best = Eigen::Vector3d::Zero();

  void try_with(std::vector<Qp::Row> active, std::size_t next) {
    const Eigen::Vector3d x = minimum_on(cost, gradient, active);
    const double value = 0.5 * x.dot(cost * x) + gradient.dot(x);
    const bool allowed = std::all_of(
        rows.begin(), rows.end(), [&](const Qp::Row& row) { return row.normal.dot(x) - row.least >= -1e-7; });
    if (allowed && value < least) {
      least = value;
      best = x;
    }
    if (active.size() == 3) return;
    for (std::size_t i = next; i < rows.size(); ++i) {
      active.push_back(rows[i]);
      try_with(active, i + 1);
      active.pop_back();
    }
  }
};

TEST(ForceDistributionQp, OneFootGetsWhatTryingEverySetOfActiveRowsGives) {
  std::mt19937 random(2);
  Qp qp;
  for (int trial = 0; trial < 60; ++trial) {
    Problem problem = random_problem(random);
    problem.cost.topRightCorner<3, 9>().setZero();  // the other feet don't care what the first does
    problem.cost.bottomLeftCorner<9, 3>().setZero();
    problem.rows.erase(std::remove_if(problem.rows.begin(), problem.rows.end(),
                                      [](const Qp::Row& row) { return row.first != 0; }),
                       problem.rows.end());
    BruteForce reference{problem.cost.topLeftCorner<3, 3>(), problem.gradient.head<3>(), problem.rows};
    reference.try_with({}, 0);
    ASSERT_TRUE(solve(problem, qp));
    ASSERT_LT((qp.solution().head<3>() - reference.best).norm(), 1e-5 * (1.0 + reference.best.norm()))
        << trial;
  }
}

TEST(ForceDistributionQp, WithoutViolatedRowsItIsTheClosedForm) {
  std::mt19937 random(3);
  Problem problem = random_problem(random);
  problem.rows.clear();
  problem.rows.push_back({0, Eigen::Vector3d::UnitX(), -1e9});
  Qp qp;
  ASSERT_TRUE(solve(problem, qp));
  EXPECT_EQ(qp.steps(), 0);
  const Qp::Vector closed = problem.cost.llt().solve(-problem.gradient);
  EXPECT_LT((qp.solution() - closed).norm(), 1e-9 * closed.norm());
}

/// What two feet share does not depend on whether the others are there and get nothing, or are not in the
/// problem.
TEST(ForceDistributionQp, FewerVariablesAreTheFirstOfAllWithTheOthersAlone) {
  std::mt19937 random(4);
  Qp few, all;
  for (int trial = 0; trial < 300; ++trial) {
    Problem problem = random_problem(random);
    problem.rows.erase(std::remove_if(problem.rows.begin(), problem.rows.end(),
                                      [](const Qp::Row& row) { return row.first >= 6; }),
                       problem.rows.end());
    few.begin(problem.cost, problem.gradient, 6);
    for (const Qp::Row& row : problem.rows) ASSERT_TRUE(few.add(row));
    ASSERT_TRUE(few.solve());
    problem.cost.bottomLeftCorner<6, 6>().setZero();
    problem.cost.topRightCorner<6, 6>().setZero();
    problem.gradient.tail<6>().setZero();
    ASSERT_TRUE(solve(problem, all));
    ASSERT_NO_FATAL_FAILURE(expect_optimal(problem, few)) << trial;
    ASSERT_LT((few.solution() - all.solution()).norm(), 1e-8 * (1.0 + all.solution().norm())) << trial;
    ASSERT_TRUE((few.solution().tail<6>().array() == 0.0).all());
  }
}

TEST(ForceDistributionQp, RowsGivenTwiceOrMeetingInOnePointDoNotDisturb) {
  Problem problem;
  problem.gradient.fill(1.0);  // wants -1 everywhere
  for (int copy = 0; copy < 3; ++copy) {
    for (int axis = 0; axis < 3; ++axis) problem.rows.push_back({0, Eigen::Vector3d::Unit(axis), 0.0});
    problem.rows.push_back({0, Eigen::Vector3d::Ones(), 0.0});
  }
  Qp qp;
  ASSERT_TRUE(solve(problem, qp));
  EXPECT_LT(qp.solution().head<3>().norm(), 1e-9);
  EXPECT_NEAR(qp.solution()[3], -1.0, 1e-12);
}

TEST(ForceDistributionQp, SaysWhenThereIsNoAnswer) {
  Problem contradiction;
  contradiction.rows = {{0, Eigen::Vector3d::UnitZ(), 2.0}, {0, -Eigen::Vector3d::UnitZ(), -1.0}};
  Qp qp;
  EXPECT_FALSE(solve(contradiction, qp));
  Problem saddle;
  saddle.cost(4, 4) = -1.0;
  EXPECT_FALSE(solve(saddle, qp));
  qp.begin(Qp::Matrix::Identity(), Qp::Vector::Zero());
  for (int row = 0; row < Qp::kMostRows; ++row) EXPECT_TRUE(qp.add({}));
  EXPECT_FALSE(qp.add({}));
}

}  // namespace
}  // namespace sprung
