#include "estimator/identification/held_pose.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "estimator/identification/robust_weights.h"

namespace sprung::identification {
namespace {

using Index = Eigen::Index;

constexpr double kNoiseBound =
    5.0;  ///< standard deviations that noise does not reach in any recording of minutes

double median(Eigen::VectorXd values) {
  double* const middle = values.data() + values.size() / 2;
  std::nth_element(values.data(), middle, values.data() + values.size());
  return *middle;
}

Index quiet_samples(const JointDataset& data, double quiet_s) {
  Index n = 0;
  while (n < data.size() && data.time_s[n] - data.time_s[0] < quiet_s) ++n;
  if (n == 0) throw std::invalid_argument("a held pose needs a quiet part to begin with");
  return n;
}

/// Of the samples from..to-1.
Push push_of(const JointDataset& data, const Eigen::VectorXd& external, Index from, Index to, double bound) {
  Push out;
  out.from_s = data.time_s[from];
  out.to_s = data.time_s[to - 1];
  out.bound = bound;
  for (Index i = from; i < to; ++i) {
    if (std::abs(external[i]) > std::abs(out.external)) out.external = external[i];
  }
  out.certain = std::abs(out.external) > bound;
  return out;
}

}  // namespace

HeldPose find_pushes(const JointDataset& data, const HeldPoseOptions& options) {
  HeldPose out;
  const Index quiet = quiet_samples(data, options.quiet_s);
  out.strayed_rad = (data.position_rad.array() - data.position_rad[0]).abs().maxCoeff();
  if (out.strayed_rad > options.moved_rad)
    throw std::invalid_argument("the joint strays " + std::to_string(out.strayed_rad) +
                                " rad: it holds no pose");
  out.torque = median(data.measured_torque.head(quiet));
  const Eigen::VectorXd external = (out.torque - data.measured_torque.array()).matrix();
  out.noise = robust_scale(external.head(quiet));
  const double threshold = options.breakaway + kNoiseBound * out.noise;
  for (Index from = 0, to = 0; from < data.size(); from = to + 1) {
    to = from;
    // One push has one direction.
    while (to < data.size() && std::abs(external[to]) > threshold && external[to] * external[from] > 0.0)
      ++to;
    if (to > from && data.time_s[to - 1] - data.time_s[from] >= options.least_s)
      out.pushes.push_back(push_of(data, external, from, to, threshold + options.breakaway));
    if (to > from) --to;
  }
  return out;
}

}  // namespace sprung::identification
