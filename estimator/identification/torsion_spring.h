#pragma once
/// Spring of a strain wave gear: stiffness that grows in stages with the torque, as data sheets give it. Odd:
/// the same both ways. Pure.
#include <vector>

namespace sprung::identification {

struct TorsionStage {
  double from_Nm = 0.0;           ///< the stage acts beyond this |torque|; 0 in the first
  double stiffness_Nm_rad = 0.0;  ///< > 0
};

class TorsionSpring {
 public:
  /// @throws std::invalid_argument unless there is a stage, the first begins at 0, they ascend, and
  /// stiffnesses are positive.
  explicit TorsionSpring(std::vector<TorsionStage> stages);

  double angle_rad(double torque_Nm) const noexcept;
  double torque_Nm(double angle_rad) const noexcept;

 private:
  std::vector<TorsionStage> stages_;
  std::vector<double> from_rad_;  ///< angle at which each stage begins
};

}  // namespace sprung::identification
