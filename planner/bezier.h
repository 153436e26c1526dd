#pragma once
/// Bezier curve of one quantity over time, by De Casteljau's construction. Pure; evaluation allocates
/// nothing.
#include <array>
#include <vector>

namespace sprung {

struct CurvePoint {
  double value = 0.0;
  double rate_1_s = 0.0;           ///< first derivative by time
  double acceleration_1_s2 = 0.0;  ///< second
};

class Bezier {
 public:
  static constexpr int kMaxDegree = 16;

  /// @param control_points two to 17; the curve begins at the first and ends at the last.
  /// @throws std::invalid_argument on any other number, on one that is not finite, or unless duration > 0.
  Bezier(const std::vector<double>& control_points, double duration_s);

  /// Outside [0, duration] it rests at the nearer end.
  CurvePoint at(double time_s) const noexcept;
  double duration_s() const noexcept { return duration_s_; }
  double end() const noexcept { return points_[degree_]; }

 private:
  std::array<double, kMaxDegree + 1> points_{};
  int degree_ = 0;
  double duration_s_ = 0.0;
};

}  // namespace sprung
