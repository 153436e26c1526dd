#pragma once
/// Generalised Maxwell slip: what takes the place of sgn(w) while a joint has not yet slid. Four elastic
/// elements side by side, each with a quarter of the friction, stick until they are stretched by their own
/// angle and then slip (docs/sources.md, facts D3, D4). It depends on the path and not on the time: no drift
/// under any oscillation within the elastic range, not even by rounding, since each element keeps where it is
/// anchored. Pure, no heap.
#include <array>

namespace sprung {

class PreslidingState {
 public:
  /// @param presliding_rad angle at which the first stiffness would give full friction, >= 0; all elements
  /// slide after 3.75 times that. 0 = rigid: the sign of the last movement (0 before the first).
  explicit PreslidingState(double presliding_rad = 0.0) noexcept : presliding_rad_(presliding_rad) {}

  /// Forgets the path. @param sign of all elements: what friction is at the start cannot be known; two states
  /// from -1 and +1 bracket every other and meet once the joint has slid.
  void reset(double position_rad, double sign = 0.0) noexcept;
  /// @return sign() at this position. The first step resets.
  double step(double position_rad) noexcept;

  double sign() const noexcept { return sign_; }  ///< in [-1, 1]
  /// By presliding_rad, along the path so far; 0 when all elements slide.
  double sign_by_presliding_1_rad() const noexcept { return by_presliding_1_rad_; }
  /// Every element has slipped since reset(): nothing is left of how it began.
  bool known() const noexcept { return unslipped_ == 0; }

 private:
  struct Element {
    double anchor_rad = 0.0;
    double anchor_by_presliding = 0.0;
    bool slipped = false;
  };
  void step_rigid(double position_rad) noexcept;

  static constexpr int kElements = 4;
  double presliding_rad_;
  std::array<Element, kElements> elements_{};
  double position_rad_ = 0.0;
  double sign_ = 0.0;
  double by_presliding_1_rad_ = 0.0;
  int unslipped_ = kElements;
  bool started_ = false;
};

}  // namespace sprung
