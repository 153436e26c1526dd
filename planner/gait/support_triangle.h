#pragma once
/// The three feet that go on standing while the fourth is lifted, seen from above; and where a body is safe
/// over them. Level axes. Pure.
#include <Eigen/Core>
#include <array>

namespace sprung {

class SupportTriangle {
 public:
  explicit SupportTriangle(const std::array<Eigen::Vector2d, 3>& feet_m) noexcept;

  /// From the nearest side; negative outside. Feet in a line: no place is inside.
  double margin_m(const Eigen::Vector2d& place_m) const noexcept;
  /// The nearest place to `from_m` on the way to the middle of the inscribed circle (the safest of all) with
  /// that margin; that middle where the triangle has none. From a place that is safe already: that place.
  Eigen::Vector2d safe_place_m(const Eigen::Vector2d& from_m, double margin_m) const noexcept;

 private:
  double distance_m(std::size_t side, const Eigen::Vector2d& place_m) const noexcept;

  std::array<Eigen::Vector2d, 3> feet_m_;
  /// Unit normal of the side that begins at the foot of the same index.
  std::array<Eigen::Vector2d, 3> inward_;
  Eigen::Vector2d middle_m_;
  double inradius_m_;
};

}  // namespace sprung
