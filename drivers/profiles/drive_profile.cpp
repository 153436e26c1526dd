#include "drivers/profiles/drive_profile.h"

#include <stdexcept>

#include "drivers/profiles/gold/gold_profile.h"

namespace sprung {

std::unique_ptr<DriveProfile> make_profile(const ActuatorConfig& actuator, const DriveTiming& timing) {
  if (actuator.profile == "gold") return std::make_unique<gold::GoldProfile>(actuator, timing);
  throw std::invalid_argument("actuator '" + actuator.name + "': no drive profile '" + actuator.profile +
                              "'; there are: gold");
}

}  // namespace sprung
