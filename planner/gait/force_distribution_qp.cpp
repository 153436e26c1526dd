#include "planner/gait/force_distribution_qp.h"

#include <cmath>
#include <limits>

namespace sprung {
namespace {

/// A normal depends on the active ones when less than this share of it (squared) is left beside them;
/// rounding leaves about 1e-30. With 1e-13 one of 800 random problems was answered 1e-5 beside the optimum.
constexpr double kDependent = 1e-20;

}  // namespace

void ForceDistributionQp::begin(const Matrix& cost, const Vector& gradient, int variables) noexcept {
  variables_ = variables;
  cost_.compute(cost.topLeftCorner(variables, variables));
  x_.setZero();
  x_.head(variables) = -cost_.solve(gradient.head(variables));
  row_count_ = 0;
  active_count_ = 0;
  steps_ = 0;
}

bool ForceDistributionQp::add(const Row& row) noexcept {
  if (row_count_ == kMostRows) return false;
  rows_[row_count_++] = row;
  return true;
}

bool ForceDistributionQp::solve() noexcept {
  if (cost_.info() != Eigen::Success) return false;
  for (int row = most_violated(); row >= 0; row = most_violated()) {
    if (!enforce(row)) return false;
  }
  return true;
}

double ForceDistributionQp::price(int row) const noexcept {
  for (int i = 0; i < active_count_; ++i) {
    if (active_[i] == row) return prices_[i];
  }
  return 0.0;
}

int ForceDistributionQp::most_violated() const noexcept {
  int worst = -1;
  double least = -kTolerance;
  for (int row = 0; row < row_count_; ++row) {
    const double value = excess(rows_[row]);
    if (value >= least || price(row) > 0.0) continue;
    worst = row;
    least = value;
  }
  return worst;
}

ForceDistributionQp::Vector ForceDistributionQp::scaled_normal(int row) const noexcept {
  Vector normal = Vector::Zero();
  normal.segment<3>(rows_[row].first) = rows_[row].normal;
  auto part = normal.head(variables_);
  cost_.matrixL().solveInPlace(part);
  return normal;
}

ForceDistributionQp::Direction ForceDistributionQp::direction(const Vector& normal) const noexcept {
  Direction along{Vector::Zero(), normal, Vector::Zero(), 0.0};
  for (int pass = 0; pass < 2; ++pass) {  // the second takes away what rounding left of the first
    for (int i = 0; i < active_count_; ++i) {
      const double share = basis_.col(i).dot(along.rest);
      along.coordinates[i] += share;
      along.rest -= share * basis_.col(i);
    }
  }
  for (int i = active_count_ - 1; i >= 0; --i) {
    double value = along.coordinates[i];
    for (int j = i + 1; j < active_count_; ++j) value -= triangle_(i, j) * along.prices[j];
    along.prices[i] = value / triangle_(i, i);
  }
  const double left = along.rest.squaredNorm();
  along.rest_squared = left > kDependent * normal.squaredNorm() ? left : 0.0;
  return along;
}

int ForceDistributionQp::first_to_leave(const Direction& along, double& length) const noexcept {
  int place = -1;
  length = std::numeric_limits<double>::infinity();
  for (int i = 0; i < active_count_; ++i) {
    if (along.prices[i] <= 0.0 || prices_[i] >= length * along.prices[i]) continue;
    length = prices_[i] / along.prices[i];
    place = i;
  }
  return place;
}

/// Raises the row's price until the row holds; active rows whose price falls to 0 on the way leave.
bool ForceDistributionQp::enforce(int row) noexcept {
  const Vector normal = scaled_normal(row);
  double price = 0.0;
  while (steps_++ < kMostSteps) {
    const Direction along = direction(normal);
    double length = 0.0;
    const int leaving = first_to_leave(along, length);
    const bool free = along.rest_squared > 0.0;
    const double full = free ? -excess(rows_[row]) / along.rest_squared
                             : std::numeric_limits<double>::infinity();
    if (!free && leaving < 0) return false;
    const double step = full <= length ? full : length;
    if (free) {
      Vector toward = along.rest;
      auto part = toward.head(variables_);
      cost_.matrixU().solveInPlace(part);
      x_ += step * toward;
    }
    prices_ -= step * along.prices;
    price += step;
    if (full <= length) {
      take_in(row, price, along);
      return true;
    }
    let_go(leaving);
  }
  return false;
}

void ForceDistributionQp::take_in(int row, double price, const Direction& along) noexcept {
  const double length = std::sqrt(along.rest_squared);
  basis_.col(active_count_) = along.rest / length;
  triangle_.col(active_count_) = along.coordinates;
  triangle_(active_count_, active_count_) = length;
  prices_[active_count_] = price;
  active_[active_count_++] = row;
}

/// Takes the others in again from that place on: a dozen columns of a dozen numbers.
void ForceDistributionQp::let_go(int place) noexcept {
  const int count = active_count_;
  active_count_ = place;
  for (int i = place + 1; i < count; ++i) {
    const int row = active_[i];
    take_in(row, prices_[i], direction(scaled_normal(row)));
  }
}

}  // namespace sprung
