#include "planner/bezier.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sprung {

Bezier::Bezier(const std::vector<double>& control_points, double duration_s)
    : degree_(static_cast<int>(control_points.size()) - 1), duration_s_(duration_s) {
  if (degree_ < 1 || degree_ > kMaxDegree)
    throw std::invalid_argument("bezier: needs 2 to 17 control points");
  if (!(duration_s > 0.0)) throw std::invalid_argument("bezier: duration must be positive");
  for (double p : control_points) {
    if (!std::isfinite(p)) throw std::invalid_argument("bezier: control points must be finite");
  }
  std::copy(control_points.begin(), control_points.end(), points_.begin());
}

CurvePoint Bezier::at(double time_s) const noexcept {
  if (time_s < 0.0) return {points_[0], 0.0, 0.0};
  if (time_s > duration_s_) return {end(), 0.0, 0.0};
  const double u = time_s / duration_s_;
  std::array<double, kMaxDegree + 1> b = points_;
  CurvePoint out;
  for (int left = degree_; left > 0; --left) {
    // b holds left + 1 points here; differences of the last three and two are the derivatives.
    if (left == 2) {
      out.acceleration_1_s2 = degree_ * (degree_ - 1) * (b[2] - 2.0 * b[1] + b[0]) /
                              (duration_s_ * duration_s_);
    }
    if (left == 1) out.rate_1_s = degree_ * (b[1] - b[0]) / duration_s_;
    for (std::size_t i = 0; i < static_cast<std::size_t>(left); ++i) b[i] = (1.0 - u) * b[i] + u * b[i + 1];
  }
  out.value = b[0];
  return out;
}

}  // namespace sprung
