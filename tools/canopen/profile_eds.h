#pragma once
/// The EDS in each profile's folder, built into the program. Pure.
#include <string>

namespace sprung::cantools {

/// Text of drivers/profiles/<profile>/<profile>.eds; nullptr where the folder has none.
const char* profile_eds_text(const std::string& profile);

}  // namespace sprung::cantools
