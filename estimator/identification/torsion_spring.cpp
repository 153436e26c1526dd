#include "estimator/identification/torsion_spring.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace sprung::identification {

TorsionSpring::TorsionSpring(std::vector<TorsionStage> stages) : stages_(std::move(stages)) {
  if (stages_.empty() || stages_.front().from_Nm != 0.0)
    throw std::invalid_argument("the first stage of a torsion spring begins at 0 Nm");
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    if (!(stages_[i].stiffness_Nm_rad > 0.0))
      throw std::invalid_argument("stage " + std::to_string(i) +
                                  " of a torsion spring needs a positive stiffness");
    if (i > 0 && !(stages_[i].from_Nm > stages_[i - 1].from_Nm))
      throw std::invalid_argument("stage " + std::to_string(i) +
                                  " of a torsion spring begins before the one below");
    from_rad_.push_back(i == 0 ? 0.0
                               : from_rad_[i - 1] + (stages_[i].from_Nm - stages_[i - 1].from_Nm) /
                                                        stages_[i - 1].stiffness_Nm_rad);
  }
}

double TorsionSpring::angle_rad(double torque_Nm) const noexcept {
  const double size_Nm = std::abs(torque_Nm);
  std::size_t i = stages_.size() - 1;
  while (i > 0 && size_Nm < stages_[i].from_Nm) --i;
  return std::copysign(from_rad_[i] + (size_Nm - stages_[i].from_Nm) / stages_[i].stiffness_Nm_rad,
                       torque_Nm);
}

double TorsionSpring::torque_Nm(double angle_rad) const noexcept {
  const double size_rad = std::abs(angle_rad);
  std::size_t i = stages_.size() - 1;
  while (i > 0 && size_rad < from_rad_[i]) --i;
  return std::copysign(stages_[i].from_Nm + (size_rad - from_rad_[i]) * stages_[i].stiffness_Nm_rad,
                       angle_rad);
}

}  // namespace sprung::identification
