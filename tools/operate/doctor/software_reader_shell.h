#pragma once
/// Versions of LCM, of the programs beside this one, and of the robot that is up.
#include <string>
#include <vector>

#include "tools/operate/doctor/machine_facts.h"

namespace sprung::doctor {

/// @param programs that must be there, in `folder`. @param instance whose processes are listened to, if it is
/// up.
SoftwareFacts read_software(const std::string& folder, const std::vector<std::string>& programs,
                            const std::string& instance);

/// "0.1.0 (abc)" of what `PROGRAM --version` prints, "sprung-x 0.1.0 (abc)"; empty where it cannot be run.
std::string program_version(const std::string& path);

}  // namespace sprung::doctor
