#pragma once
/// The result of an experiment: rows of design section 9, as JSON for scripts and as a table for people.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sprung {

struct ReportRow {
  std::string name;  ///< <experiment>.<case>.<quantity>
  std::string unit;
  double value = 0.0;           ///< NaN = not reached; printed as null, and not ok where the row has bounds
  std::optional<double> paper;  ///< the papers' figure, where there is one
  std::optional<double> low;    ///< bounds, where they are demanded
  std::optional<double> high;

  bool ok() const;
};

struct ExperimentReport {
  std::string experiment;
  std::string robot;
  std::string preset;
  std::uint64_t seed = 0;
  bool separate_processes = false;
  double wall_s = 0.0;
  double simulated_s = 0.0;
  std::vector<ReportRow> rows;

  bool ok() const;  ///< every row with bounds is within them
  std::string json() const;
  std::string table() const;
};

}  // namespace sprung
