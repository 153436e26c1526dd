#pragma once
/// Angles as an operator types them: "0.5rad", "30 deg", "-1.2 rad/s", "90deg/s^2". Pure.
#include <string>

namespace sprung {

/// @param per what follows the angle's unit: "" for an angle, "/s" for a speed, "/s^2" for an acceleration.
/// @return in rad. @throws std::invalid_argument saying what was found and an example of what was expected.
double parse_angle_rad(const std::string& text, const std::string& per = "");

}  // namespace sprung
