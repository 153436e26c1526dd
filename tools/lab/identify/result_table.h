#pragma once
/// The result as tables for people. Pure.
#include <string>

#include "tools/lab/identify/identified_joint.h"

namespace sprung::identify {

/// Models beside each other, the chosen one's parameters, warnings.
std::string result_table(const IdentifiedJoint& joint);

/// "1.79 +- 0.02 Nm", with as many digits as the standard error allows.
std::string with_error(double value, double standard_error, const std::string& unit);

}  // namespace sprung::identify
