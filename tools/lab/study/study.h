#pragma once
/// A study: one experiment on many robots that differ by a few numbers, on many plants, with many seeds. What
/// STUDY.yaml says (docs/studies.md), and the runs that it means. Pure.
///
///   study: landing
///   experiment: jump
///   options: {mode: hybrid}
///   parameters:
///     presets.best.hybrid_landing.stiffness.z: {from: 400 N/m, to: 3000 N/m, points: 5}
///   draws: 1..20
///   seeds: 1..3
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sprung {

/// A number of robot.yaml that is varied, in the unit that the file gives it.
struct StudyParameter {
  std::string path;  ///< from the top of robot.yaml
  std::string unit;
  double present = 0.0;  ///< robot.yaml's own
  double from = 0.0;
  double to = 0.0;
  bool logarithmic = false;
  std::vector<double> values;  ///< those of a grid

  /// @param share 0 ... 1 of the range. Four significant digits, so that robot.yaml can hold what was tried.
  double at(double share) const;
};

/// Part of what a plant cost: of one row of the experiment.
struct StudyTerm {
  std::string row;
  double weight = 1.0;
  std::optional<double> about{};  ///< its distance from here counts
  std::optional<double> above{};  ///< and only what of it is beyond here
  double unreached = 0.0;         ///< for a row that has no value, and for a run that failed
};

struct StudyGoal {
  std::string name;
  bool is_least = true;  ///< the less the better
  bool is_worst = true;  ///< the worst plant counts; else their mean
  std::vector<StudyTerm> terms;
};

/// What `sprung-study tune` looks for (python/sprung_study/tune.py).
struct StudyTuning {
  std::vector<StudyGoal> goals;
  int trials = 64;
  std::int64_t runs = 0;   ///< above 0: no new trials once so many runs were made, whatever `trials` says
  std::uint64_t seed = 0;  ///< of the search
  bool prunes = true;      ///< a set that is bad on the first plants is not tried on the others
  int finalists = 5;  ///< so many of the best are also judged on `validate`, and the best of all is taken
  std::vector<std::vector<std::string>> validate;  ///< plants; empty: what was best on the study's is taken
  std::vector<std::vector<std::string>>
      held_out;  ///< plants that the best is reported on, and chosen by none
};

struct Study {
  std::string name;
  std::string file;  ///< for messages
  std::string experiment;
  std::string robot;
  std::string preset;                ///< empty: the experiment's usual one
  std::vector<std::string> options;  ///< of the experiment, as words: "--mode", "hybrid"
  std::vector<StudyParameter> parameters;
  int samples = 0;  ///< above 0: so many sets that fill the ranges evenly, instead of each with each
  std::vector<std::vector<std::string>> plants;  ///< at least one; each of KEY=VALUE
  std::vector<std::uint64_t> seeds;              ///< at least one
  double timeout_s = 600.0;                      ///< of a run
  std::vector<std::string> show;                 ///< rows that the page draws; empty: those with bounds
  std::optional<StudyTuning> tuning;
};

/// One line of `sprung study expand`.
struct StudyRun {
  std::int64_t number = 0;  ///< from 1
  std::string study;        ///< study_hash()
  std::string experiment;
  std::string robot;
  std::string preset;
  std::vector<std::string> options;
  std::map<std::string, double> parameters;
  std::vector<std::string> plant;
  std::uint64_t seed = 0;
};

/// Of what is run, whatever comments, order of keys, time-out and what is shown: 16 hexadecimal digits.
std::string study_hash(const Study& study);

/// Sets of numbers, one for each of the parameters: every combination, the last parameter first through, or
/// `samples` even ones. One empty set where nothing is varied.
std::vector<std::vector<double>> study_sets(const Study& study);

/// Those that a search begins with: robot.yaml's own where they lie in their ranges, else their nearest ends,
/// then even ones, for six tenths of its trials; others for another seed.
std::vector<std::vector<double>> first_sets(const Study& study);

std::int64_t run_count(const Study& study);
/// Sets, in each set the plants, on each plant the seeds: what belongs together stands together.
std::vector<StudyRun> study_runs(const Study& study);

/// "17,20..23". @param numbers ascending.
std::string ranges_text(const std::vector<std::int64_t>& numbers);

}  // namespace sprung
