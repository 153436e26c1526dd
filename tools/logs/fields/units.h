#pragma once
/// Units as names carry them: "joint_speed_rad_s" is in rad/s.
#include <cstddef>
#include <string>
#include <string_view>

namespace sprung::fields {

/// "" where the name carries none. @param index of the element where the member is a list whose elements
/// differ (wrench[6]: N, then Nm), else 0.
std::string unit_of(std::string_view member, std::size_t index = 0);

}  // namespace sprung::fields
