#pragma once
/// The Python part of studies, python/sprung_study: adapters of engines, and what Python's libraries do best.
#include <string>
#include <vector>

namespace sprung {

/// Runs `python3 -m sprung_study WORDS...` ($SPRUNG_PYTHON in place of python3), its module beside the
/// sources or where sprung is installed. @return why it did not do it, with the remedy; empty: it did.
std::string run_study_python(const std::vector<std::string>& words);

}  // namespace sprung
