#include "tools/lab/run/experiment_index.h"

#include <sprung_version.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "robots/text_hash.h"

namespace sprung {

namespace {

using report::Cell;
using report::Mark;
using Json = nlohmann::ordered_json;

struct RowCounts {
  std::size_t rows = 0, demands = 0, met = 0;
};

RowCounts count_rows(const FinishedExperiment& experiment) {
  RowCounts counts;
  for (const ReportRow& row : experiment.rows.rows) {
    ++counts.rows;
    if (!row.low && !row.high) continue;
    ++counts.demands;
    counts.met += row.ok() ? 1 : 0;
  }
  return counts;
}

std::string version_text(const IndexHeading& heading) {
  return heading.robot + " (robot.yaml " + hash_digits(static_cast<std::int64_t>(heading.robot_hash)) +
         "), seed " + std::to_string(heading.seed) + ", sprung " SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
}

std::string bounds_text(const ReportRow& row) {
  if (row.low && row.high) return report::number_text(*row.low) + " to " + report::number_text(*row.high);
  if (row.low) return ">= " + report::number_text(*row.low);
  return row.high ? "<= " + report::number_text(*row.high) : "";
}

std::vector<Cell> row_cells(const ReportRow& row) {
  const bool bounded = row.low || row.high;
  return {row.name,
          row.unit,
          row.paper ? Cell(*row.paper) : Cell(""),
          Cell(row.value, !bounded   ? Mark::kPlain
                          : row.ok() ? Mark::kGood
                                     : Mark::kBad),
          row.paper && *row.paper != 0.0 ? Cell(row.value / *row.paper) : Cell(""),
          bounds_text(row)};
}

report::Table rows_table(const FinishedExperiment& experiment) {
  report::Table table{"Rows", {"row", "unit", "paper", "ours", "ours / paper", "demanded"}};
  for (const ReportRow& row : experiment.rows.rows) table.rows.push_back(row_cells(row));
  return table;
}

std::vector<Cell> summary_cells(const FinishedExperiment& experiment) {
  const RowCounts counts = count_rows(experiment);
  Cell name(experiment.name);
  name.link = experiment.name + ".html";
  const std::string met = std::to_string(counts.met) + " of " + std::to_string(counts.demands);
  return {name,
          experiment.question,
          experiment.rows.preset,
          counts.rows,
          experiment.failure.empty() ? Cell(met, experiment.ok() ? Mark::kGood : Mark::kBad)
                                     : Cell("failed", Mark::kBad),
          experiment.rows.wall_s};
}

report::Section summary(const std::vector<FinishedExperiment>& experiments) {
  report::Section section{"Summary"};
  report::Table table{"", {"experiment", "question", "preset", "rows", "demands met", "took (s)"}};
  for (const FinishedExperiment& experiment : experiments) table.rows.push_back(summary_cells(experiment));
  table.note =
      "A demand is a row with bounds. Rows without bounds are there to compare with the paper or with each "
      "other.";
  section.tables = {table};
  return section;
}

report::Section rows_section(const FinishedExperiment& experiment) {
  report::Section section{experiment.name};
  section.text = {experiment.question, "Made by: " + experiment.command};
  if (!experiment.failure.empty()) {
    section.text.push_back("It failed: " + experiment.failure);
    return section;
  }
  section.tables = {rows_table(experiment)};
  return section;
}

void append_figures(const FinishedExperiment& experiment, report::Report& page) {
  for (report::Section section : experiment.output.sections) {
    section.heading = experiment.name + ": " + section.heading;
    page.sections.push_back(section);
  }
}

Json experiment_json(const FinishedExperiment& experiment) {
  Json json = Json::parse(experiment.rows.json());
  json["ok"] = experiment.ok();
  json["failure"] = experiment.failure.empty() ? Json(nullptr) : Json(experiment.failure);
  return json;
}

}  // namespace

report::Report experiment_index(const IndexHeading& heading,
                                const std::vector<FinishedExperiment>& experiments) {
  report::Report page{"Experiments on " + heading.robot, version_text(heading), heading.command};
  page.sections.push_back(summary(experiments));
  for (const FinishedExperiment& experiment : experiments) {
    page.sections.push_back(rows_section(experiment));
    append_figures(experiment, page);
  }
  return page;
}

report::Report experiment_page(const IndexHeading& heading, const FinishedExperiment& experiment) {
  report::Report page{experiment.name + " on " + heading.robot,
                      "preset " + experiment.rows.preset + ", " + version_text(heading), experiment.command};
  page.sections.push_back(rows_section(experiment));
  page.sections.insert(page.sections.end(), experiment.output.sections.begin(),
                       experiment.output.sections.end());
  return page;
}

std::string experiment_index_json(const IndexHeading& heading,
                                  const std::vector<FinishedExperiment>& experiments) {
  Json json;
  json["robot"] = heading.robot;
  json["robot_hash"] = hash_digits(static_cast<std::int64_t>(heading.robot_hash));
  json["seed"] = heading.seed;
  json["version"] = SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
  json["command"] = heading.command;
  json["wall_s"] = heading.wall_s;
  json["ok"] = std::all_of(experiments.begin(), experiments.end(),
                           [](const FinishedExperiment& experiment) { return experiment.ok(); });
  json["experiments"] = Json::array();
  for (const FinishedExperiment& experiment : experiments)
    json["experiments"].push_back(experiment_json(experiment));
  return json.dump(1);
}

std::string experiment_index_text(const std::vector<FinishedExperiment>& experiments) {
  std::string text;
  char line[160];
  for (const FinishedExperiment& experiment : experiments) {
    const RowCounts counts = count_rows(experiment);
    std::snprintf(line, sizeof line, "%-16s preset %-6s %4zu rows, %zu of %zu demands met, %.1f s%s%s\n",
                  experiment.name.c_str(), experiment.rows.preset.c_str(), counts.rows, counts.met,
                  counts.demands, experiment.rows.wall_s,
                  experiment.failure.empty() ? "" : ", FAILED: ", experiment.failure.substr(0, 60).c_str());
    text += line;
  }
  return text;
}

}  // namespace sprung
