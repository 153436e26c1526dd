#pragma once
/// What a study's folder holds, for people and for other programs. Pure.
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/common/report/report.h"
#include "tools/lab/study/study_row.h"

namespace sprung {

struct StudyColumn {
  std::string name;
  std::string unit;  ///< "" = a bare number
};

/// A row a run, in their order; a number that a run does not have is NaN.
struct StudyTable {
  std::vector<std::string> parameters;
  std::vector<StudyColumn> columns;  ///< rows of the experiment, in the order in which they were first seen
  std::vector<StudyResult> results;  ///< ascending
};

/// What is said of a whole study.
struct StudyState {
  std::string name;
  StudyOrigin origin;
  std::int64_t runs = 0;                        ///< that it has; 0: nobody knows (tuning)
  std::vector<std::int64_t> missing;            ///< ascending
  std::map<std::int64_t, std::string> reasons;  ///< of missing ones that were tried
  std::string command;                          ///< that goes on
};

StudyTable study_table(std::vector<StudyResult> results);

/// One line a run: run, seed, plant, parameters, failure, then every column, with the unit in its heading.
std::string csv_of(const StudyTable& table);

/// "998 of 1000 runs, 1 of them failed; missing: 17, 20..21 (17: took longer than 600 s)".
std::string summary_of(const StudyTable& table, const StudyState& state);

/// Distributions with the worst run's number and the line that repeats it, what is missing, and each
/// parameter against the rows in `show`. @param show names; empty: those with bounds, else the first ones.
report::Report study_page(const StudyTable& table, const StudyState& state,
                          const std::vector<std::string>& show);

}  // namespace sprung
