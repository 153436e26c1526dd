#pragma once
/// The result of an experiment: rows of design section 9, as JSON for scripts and as a table for people.
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
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
  /// How far beyond its bounds, below 0 within them; -infinity where it has none. A value that was not
  /// reached is worse than any: infinity.
  double excess() const;
};

/// What a row is held against; empty: nothing is demanded.
struct Bounds {
  std::optional<double> low{}, high{};
  std::optional<double> paper{};  ///< the papers' figure, where there is one
};
inline Bounds at_least(double low) { return {low, {}, {}}; }
inline Bounds at_most(double high) { return {{}, high, {}}; }
inline Bounds between(double low, double high) { return {low, high, {}}; }
inline Bounds demanded(bool really, const Bounds& bounds) { return really ? bounds : Bounds{}; }

/// Every row with bounds is within them.
bool all_ok(const std::vector<ReportRow>& rows);

ReportRow row(const std::string& name, const std::string& unit, double value, const Bounds& bounds = {});

/// As they stand in an experiment's JSON and in the rows of a study.
nlohmann::ordered_json rows_json(const std::vector<ReportRow>& rows);
/// The reverse. @throws nlohmann::json::exception where they are none.
std::vector<ReportRow> rows_of_json(const nlohmann::ordered_json& json);

struct ExperimentReport {
  std::string experiment;
  std::string robot;
  std::string preset;
  std::uint64_t seed = 0;
  bool separate_processes = false;
  double wall_s = 0.0;
  double simulated_s = 0.0;
  std::vector<ReportRow> rows;

  bool ok() const { return all_ok(rows); }
  std::string json() const;
  std::string table() const;
};

}  // namespace sprung
