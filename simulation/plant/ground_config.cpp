#include "simulation/plant/ground_config.h"

namespace sprung::sim {

void GroundConfig::scale_heights(double scale) noexcept {
  const auto steeper = [scale](double rad) { return std::atan(scale * std::tan(rad)); };
  slope_rad = steeper(slope_rad);
  side_slope_rad = steeper(side_slope_rad);
  for (double GroundConfig::*height : {&GroundConfig::wave_m, &GroundConfig::rough_m, &GroundConfig::error_m})
    this->*height *= scale;
  for (GroundStep& step : steps) step.height_m *= scale;
  for (GroundRamp& ramp : ramps) ramp.slope_rad = steeper(ramp.slope_rad);
}

}  // namespace sprung::sim
