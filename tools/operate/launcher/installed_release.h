#pragma once
/// Whether program, message definitions and robot files of an installation are of one build:
/// share/sprung/release holds what `sprung version` said when they were installed.
#include <string>

namespace sprung {

/// Lines "version: 0.1.0", "build: <git hash>", "message_types: <hash>" of this program.
std::string release_text();

/// One sentence that names the file, the first thing that differs with both values, and what to do; empty
/// where nothing differs. Pure.
std::string why_not_of_release(const std::string& installed, const std::string& own, const std::string& file);

/// @throws std::runtime_error as why_not_of_release() says of share/sprung/release beside the folder of the
/// program. Without that file there is nothing to check: a build folder has none.
void check_installed_release(const std::string& program_folder);

}  // namespace sprung
