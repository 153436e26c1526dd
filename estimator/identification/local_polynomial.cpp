#include "estimator/identification/local_polynomial.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sprung::identification {

namespace {

using Index = Eigen::Index;

/// Weights of the samples at `first`..`last` (counted from the one that is asked for) that give the
/// polynomial's derivative at 0, in units of 1 / sample^derivative.
Eigen::RowVectorXd weights(Index first, Index last, int degree, int derivative) {
  const Index count = last - first + 1;
  const Index terms = std::min<Index>(degree + 1, count);
  // Offsets are scaled to about 1: powers of large windows would else make the fit ill-conditioned.
  const double scale = static_cast<double>(std::max({-first, last, Index{1}}));
  Eigen::MatrixXd powers(count, terms);
  for (Index i = 0; i < count; ++i) {
    for (Index k = 0; k < terms; ++k)
      powers(i, k) = std::pow(static_cast<double>(first + i) / scale, static_cast<double>(k));
  }
  const Eigen::MatrixXd
      inverse = powers.colPivHouseholderQr().solve(Eigen::MatrixXd::Identity(count, count)).eval();
  return inverse.row(derivative) * (std::tgamma(derivative + 1.0) / std::pow(scale, derivative));
}

}  // namespace

Eigen::VectorXd local_polynomial(const Eigen::VectorXd& signal, double period_s, int half_width, int degree,
                                 int derivative) {
  const Index n = signal.size();
  if (n <= derivative || half_width < 1 || degree < derivative)
    throw std::invalid_argument("too few samples (" + std::to_string(n) + ") for a derivative of order " +
                                std::to_string(derivative));
  const Index reach = std::max<Index>(half_width, (derivative + 1) / 2);
  const Eigen::RowVectorXd inner = weights(-reach, reach, degree, derivative);
  const double unit = std::pow(period_s, -derivative);
  Eigen::VectorXd out(n);
  for (Index i = 0; i < n; ++i) {
    const Index first = std::max<Index>(-reach, -i);
    const Index last = std::min<Index>(reach, n - 1 - i);
    const bool whole = first == -reach && last == reach;
    // At an end the window keeps at least as many samples as the derivative needs.
    const Index low = whole ? first : std::min<Index>(first, std::max<Index>(-i, last - derivative));
    const Index high = whole ? last : std::max<Index>(last, std::min<Index>(n - 1 - i, low + derivative));
    const auto window = signal.segment(i + low, high - low + 1);
    out[i] = unit * (whole ? inner : weights(low, high, degree, derivative)).dot(window);
  }
  return out;
}

}  // namespace sprung::identification
