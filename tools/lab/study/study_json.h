#pragma once
/// The words of the contract (docs/studies.md): a study as one object, a run as one line. Pure.
#include <string>
#include <vector>

#include "tools/lab/study/study.h"

namespace sprung {

/// All of it, parameters with their present values, for engines that make runs of their own.
std::string study_json(const Study& study);

/// One line, without its end.
std::string run_json(const StudyRun& run);
/// @throws std::invalid_argument saying what is wrong with the line.
StudyRun run_of_json(const std::string& line);

/// As it is typed in a shell.
std::string shell_word(const std::string& word);

/// The words that follow `sprung experiment`; numbers with all their digits, so that they make the same run.
std::vector<std::string> words_of(const StudyRun& run);

}  // namespace sprung
