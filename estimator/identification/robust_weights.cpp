#include "estimator/identification/robust_weights.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sprung::identification {

namespace {

constexpr double kHuber = 3.0;
constexpr double kTukey = 4.685;

double weight(double deviations, RobustLoss loss) {
  switch (loss) {
    case RobustLoss::kNone:
      break;
    case RobustLoss::kHuber:
      return deviations <= kHuber ? 1.0 : kHuber / deviations;
    case RobustLoss::kTukey: {
      const double share = deviations / kTukey;
      return share < 1.0 ? (1.0 - share * share) * (1.0 - share * share) : 0.0;
    }
  }
  return 1.0;
}

}  // namespace

double robust_scale(const Eigen::VectorXd& residual) {
  if (residual.size() == 0) return 0.0;
  std::vector<double> size(static_cast<std::size_t>(residual.size()));
  for (std::size_t i = 0; i < size.size(); ++i) size[i] = std::abs(residual[static_cast<Eigen::Index>(i)]);
  const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  return 1.4826 * *middle;
}

Eigen::VectorXd robust_weights(const Eigen::VectorXd& residual, double scale, RobustLoss loss) {
  Eigen::VectorXd out = Eigen::VectorXd::Ones(residual.size());
  if (!(scale > 0.0)) return out;
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = weight(std::abs(residual[i]) / scale, loss);
  return out;
}

}  // namespace sprung::identification
