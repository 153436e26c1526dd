#include "planner/gait/small_cholesky.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <limits>
#include <random>

namespace sprung {
namespace {

using Cholesky = SmallCholesky<12>;

Cholesky::Matrix random_matrix(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const Cholesky::Matrix root = Cholesky::Matrix::Zero().unaryExpr([&](double) { return number(random); });
  return root * root.transpose() + 0.01 * Cholesky::Matrix::Identity();
}

TEST(SmallCholesky, SolvesWhatEigenSolvesWhateverTheSize) {
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const int size = 1 + trial % 12;
    const Cholesky::Matrix a = random_matrix(random);
    Cholesky small;
    ASSERT_TRUE(small.factorize(a, size));
    const Cholesky::Vector right = random_matrix(random).col(0);
    Cholesky::Vector x = right;
    small.forward(x);
    small.backward(x);
    const Eigen::VectorXd expected = a.topLeftCorner(size, size).llt().solve(right.head(size));
    EXPECT_LT((x.head(size) - expected).norm(), 1e-10 * expected.norm()) << size;
    EXPECT_EQ(x.tail(12 - size), right.tail(12 - size)) << "beyond the size nothing is touched";
  }
}

TEST(SmallCholesky, ForwardAloneIsByTheLowerFactor) {
  std::mt19937 random(2);
  const Cholesky::Matrix a = random_matrix(random);
  Cholesky small;
  ASSERT_TRUE(small.factorize(a, 12));
  const Cholesky::Vector right = random_matrix(random).col(0);
  Cholesky::Vector x = right;
  small.forward(x);
  EXPECT_LT((a.llt().matrixL().solve(right) - x).norm(), 1e-10 * x.norm());
}

TEST(SmallCholesky, OnlyTheLowerTriangleIsRead) {
  std::mt19937 random(3);
  Cholesky::Matrix a = random_matrix(random);
  Cholesky whole, half;
  ASSERT_TRUE(whole.factorize(a, 12));
  a.triangularView<Eigen::StrictlyUpper>().setConstant(std::numeric_limits<double>::quiet_NaN());
  ASSERT_TRUE(half.factorize(a, 12));
  Cholesky::Vector x = Cholesky::Vector::Ones(), y = x;
  whole.forward(x);
  half.forward(y);
  EXPECT_EQ(x, y);
}

TEST(SmallCholesky, RefusesWhatIsNotPositiveDefinite) {
  Cholesky small;
  Cholesky::Matrix saddle = Cholesky::Matrix::Identity();
  saddle(4, 4) = -1.0;
  EXPECT_FALSE(small.factorize(saddle, 12));
  EXPECT_TRUE(small.factorize(saddle, 4));  // the rest does not count
  saddle(4, 4) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(small.factorize(saddle, 12));
}

}  // namespace
}  // namespace sprung
