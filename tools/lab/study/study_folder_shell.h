#pragma once
/// The folder of a study: study.json (whose it is), study.yaml (a copy), rows/N.json (one row a run, each
/// whole or not there), failed/N.json (a run that gave no row, and why), times.jsonl (how long each took, for
/// `growth`; of no row). Many processes on many machines may write to it at once.
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/lab/study/study.h"
#include "tools/lab/study/study_row.h"

namespace sprung {

/// A row of another study, build or robot.
struct NotOfThisStudy : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class StudyFolder {
 public:
  /// Claims the folder for this study, or finds that it is. @throws std::runtime_error with the remedy where
  /// it is another study's, another build's or another robot's, or cannot be written.
  StudyFolder(const std::string& folder, const Study& study);
  /// One that is there. @throws std::runtime_error where it is none.
  explicit StudyFolder(const std::string& folder);

  const std::string& path() const { return folder_; }
  const std::string& name() const { return name_; }
  const std::string& study() const { return hash_; }
  const StudyOrigin& origin() const { return origin_; }
  std::int64_t runs() const { return runs_; }

  bool has(std::int64_t number) const;
  std::vector<std::int64_t> done() const;  ///< ascending
  std::string row(std::int64_t number) const;

  /// Written beside, then moved: a reader sees all of it or nothing. Twice is as good as once.
  /// @throws std::invalid_argument where it is no row, NotOfThisStudy, std::runtime_error where it cannot be
  /// written.
  void keep(const std::string& row) const;
  void note_failure(std::int64_t number, const std::string& why) const;
  void note_time(std::int64_t number, double wall_s) const;
  std::map<std::int64_t, std::string> failures() const;  ///< of runs that still have no row

 private:
  std::string folder_, name_, hash_;
  StudyOrigin origin_;
  std::int64_t runs_ = 0;
};

}  // namespace sprung
