#include "tools/lab/run/experiment_report.h"

#include <sprung_version.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>

namespace sprung {

namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

std::optional<double> number_of(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional<double>(json.get<double>());
}

/// Shares and ratios, which have no unit, say more in four digits.
std::string cell(const std::optional<double>& value, const std::string& unit) {
  if (!value) {
    return "";
  }
  char text[32];
  std::snprintf(text, sizeof text, unit.empty() ? "%.4g" : "%.1f", *value);
  return std::isfinite(*value) ? text : "not reached";
}

std::string bounds(const ReportRow& row) {
  if (!row.low && !row.high) {
    return "";
  }
  const std::string range = (row.low ? cell(row.low, row.unit) : "") + ".." +
                            (row.high ? cell(row.high, row.unit) : "");
  return range + (row.ok() ? "  ok" : "  NOT OK");
}

}  // namespace

bool ReportRow::ok() const {
  if (!low && !high) {
    return true;
  }
  return std::isfinite(value) && (!low || value >= *low) && (!high || value <= *high);
}

double ReportRow::excess() const {
  if (!std::isfinite(value)) return std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  if (low) most = std::max(most, *low - value);
  if (high) most = std::max(most, value - *high);
  return most;
}

ReportRow row(const std::string& name, const std::string& unit, double value, const Bounds& bounds) {
  return {name, unit, value, bounds.paper, bounds.low, bounds.high};
}

bool all_ok(const std::vector<ReportRow>& rows) {
  return std::all_of(rows.begin(), rows.end(), [](const ReportRow& row) { return row.ok(); });
}

Json rows_json(const std::vector<ReportRow>& rows) {
  Json out = Json::array();
  for (const ReportRow& row : rows) {
    out.push_back({{"name", row.name},
                   {"unit", row.unit},
                   {"value", number(row.value)},
                   {"paper", number(row.paper)},
                   {"low", number(row.low)},
                   {"high", number(row.high)},
                   {"ok", row.ok()}});
  }
  return out;
}

std::vector<ReportRow> rows_of_json(const Json& json) {
  std::vector<ReportRow> out;
  out.reserve(json.size());
  for (const Json& row : json) {
    const double value = number_of(row.at("value")).value_or(std::nan(""));
    out.push_back({row.at("name"), row.at("unit"), value, number_of(row.at("paper")),
                   number_of(row.at("low")), number_of(row.at("high"))});
  }
  return out;
}

std::string ExperimentReport::json() const {
  Json out;
  out["experiment"] = experiment;
  out["robot"] = robot;
  out["preset"] = preset;
  out["seed"] = seed;
  out["version"] = SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
  out["separate"] = separate_processes;
  out["wall_s"] = wall_s;
  out["simulated_s"] = simulated_s;
  out["rows"] = rows_json(rows);
  return out.dump(1);
}

std::string ExperimentReport::table() const {
  char line[200];
  std::string text = experiment;
  if (!robot.empty()) text += " on " + robot;
  if (!preset.empty()) text += ", preset " + preset;
  if (!preset.empty() || seed != 0) text += ", seed " + std::to_string(seed);  // a benchmark draws nothing
  std::snprintf(line, sizeof line, ": %.1f s simulated in %.1f s\n", simulated_s, wall_s);
  text += line;
  std::snprintf(line, sizeof line, "%-44s %5s %12s %9s  %s\n", "row", "unit", "value", "paper", "bounds");
  text += line;
  for (const ReportRow& row : rows) {
    std::snprintf(line, sizeof line, "%-44s %5s %12s %9s  %s\n", row.name.c_str(), row.unit.c_str(),
                  cell(row.value, row.unit).c_str(), cell(row.paper, row.unit).c_str(), bounds(row).c_str());
    text += line;
  }
  return text;
}

}  // namespace sprung
