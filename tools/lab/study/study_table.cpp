#include "tools/lab/study/study_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "robots/overlay.h"
#include "signals/quantile.h"
#include "tools/common/csv_cell.h"

namespace sprung {
namespace {

constexpr std::size_t kMostPlots = 12;
constexpr std::size_t kMostFailures = 20;

const ReportRow* find_row(const StudyResult& result, const std::string& name) {
  for (const ReportRow& row : result.rows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

std::string joined(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + word;
  return out;
}

std::string value_text(const ReportRow* row) {
  return row == nullptr || !std::isfinite(row->value) ? "" : exact_text(row->value);
}

std::string heading(const StudyColumn& column) {
  return column.name + (column.unit.empty() ? "" : " (" + column.unit + ")");
}

struct Distribution {
  std::vector<double> values;
  std::size_t without = 0;  ///< runs that have the row, and no value
  const StudyResult* worst = nullptr;
  double worst_excess = -std::numeric_limits<double>::infinity();
  std::size_t met = 0;
  bool is_bound = false;
};

Distribution distribution_of(const StudyTable& table, const std::string& name) {
  Distribution out;
  for (const StudyResult& result : table.results) {
    const ReportRow* row = find_row(result, name);
    if (row == nullptr) continue;
    std::isfinite(row->value) ? out.values.push_back(row->value) : static_cast<void>(++out.without);
    out.is_bound = out.is_bound || row->low || row->high;
    const double beyond = row->excess();
    if (beyond <= 0.0) ++out.met;
    if (out.worst == nullptr || beyond > out.worst_excess) {
      out.worst = &result;
      out.worst_excess = beyond;
    }
  }
  return out;
}

report::Table distributions(const StudyTable& table) {
  report::Table out{"Every row over its runs",
                    {"row", "runs", "least", "5 %", "median", "95 %", "most", "met (%)", "worst run"}};
  for (const StudyColumn& column : table.columns) {
    const Distribution one = distribution_of(table, column.name);
    std::vector<report::Cell> cells = {heading(column), one.values.size() + one.without};
    for (const double share : {0.0, 0.05, 0.5, 0.95, 1.0})
      cells.emplace_back(one.values.empty() ? std::nan("") : quantile(one.values, share));
    const double runs = static_cast<double>(one.values.size() + one.without);
    const bool is_bad = one.is_bound && one.worst_excess > 0.0;
    cells.push_back(one.is_bound ? report::Cell(100.0 * static_cast<double>(one.met) / runs)
                                 : report::Cell(""));
    cells.push_back(one.is_bound ? report::Cell(std::to_string(one.worst->number),
                                                is_bad ? report::Mark::kBad : report::Mark::kGood)
                                 : report::Cell(""));
    out.rows.push_back(std::move(cells));
  }
  return out;
}

report::Table worst_runs(const StudyTable& table) {
  report::Table out{
      "Lines that repeat the worst runs", {"row", "run", "line"}, {}, "Bit for bit, with this build."};
  for (const StudyColumn& column : table.columns) {
    const Distribution one = distribution_of(table, column.name);
    if (one.is_bound)
      out.rows.push_back({column.name, std::to_string(one.worst->number), one.worst->command});
  }
  return out;
}

std::size_t failed_count(const StudyTable& table) {
  return static_cast<std::size_t>(std::count_if(table.results.begin(), table.results.end(),
                                                [](const StudyResult& one) { return !one.failure.empty(); }));
}

report::Table failures(const StudyTable& table) {
  report::Table out{"Runs that failed, the first of them", {"run", "why", "line"}};
  for (const StudyResult& one : table.results) {
    if (one.failure.empty() || out.rows.size() >= kMostFailures) continue;
    out.rows.push_back({std::to_string(one.number), one.failure, one.command});
  }
  return out;
}

std::vector<StudyColumn> shown(const StudyTable& table, const std::vector<std::string>& show) {
  std::vector<StudyColumn> out;
  for (const StudyColumn& column : table.columns) {
    const bool is_asked = std::find(show.begin(), show.end(), column.name) != show.end();
    if (show.empty() ? distribution_of(table, column.name).is_bound : is_asked) out.push_back(column);
  }
  if (out.empty() && show.empty()) out = table.columns;
  return out;
}

report::Plot scatter(const StudyTable& table, const std::string& parameter, const StudyColumn& column) {
  report::Plot plot{column.name, {parameter}, {column.name, column.unit}};
  report::Series runs{"a run each", {}, {}, report::Style::kPoints};
  for (const StudyResult& result : table.results) {
    const ReportRow* row = find_row(result, column.name);
    if (row == nullptr) continue;
    runs.x.push_back(result.run.parameters.at(parameter));
    runs.y.push_back(row->value);
  }
  plot.series.push_back(std::move(runs));
  return plot;
}

std::vector<report::Section> parameter_sections(const StudyTable& table,
                                                const std::vector<std::string>& show) {
  std::vector<report::Section> out;
  for (const std::string& parameter : table.parameters) {
    report::Section section{"By " + parameter};
    for (const StudyColumn& column : shown(table, show)) {
      if (section.plots.size() < kMostPlots) section.plots.push_back(scatter(table, parameter, column));
    }
    out.push_back(std::move(section));
  }
  return out;
}

}  // namespace

StudyTable study_table(std::vector<StudyResult> results) {
  StudyTable table;
  std::sort(results.begin(), results.end(),
            [](const StudyResult& a, const StudyResult& b) { return a.number < b.number; });
  std::map<std::string, bool> seen;
  for (const StudyResult& result : results) {
    for (const ReportRow& row : result.rows) {
      if (seen.emplace(row.name, true).second) table.columns.push_back({row.name, row.unit});
    }
  }
  if (!results.empty())
    for (const auto& [path, value] : results.front().run.parameters) table.parameters.push_back(path);
  table.results = std::move(results);
  return table;
}

std::string csv_of(const StudyTable& table) {
  std::string out = "run,seed,plant";
  const auto add = [&](const std::string& text) { append_cell(text, out += ","); };
  for (const std::string& parameter : table.parameters) add(parameter);
  add("failure");
  for (const StudyColumn& column : table.columns) add(heading(column));
  out += "\n";
  for (const StudyResult& one : table.results) {
    out += std::to_string(one.number);
    add(std::to_string(one.run.seed));
    add(joined(one.run.plant));
    for (const std::string& parameter : table.parameters) add(exact_text(one.run.parameters.at(parameter)));
    add(one.failure);
    std::map<std::string, const ReportRow*> rows;
    for (const ReportRow& row : one.rows) rows.emplace(row.name, &row);
    for (const StudyColumn& column : table.columns) {
      const auto found = rows.find(column.name);
      add(value_text(found == rows.end() ? nullptr : found->second));
    }
    out += "\n";
  }
  return out;
}

std::string summary_of(const StudyTable& table, const StudyState& state) {
  std::string text = std::to_string(table.results.size());
  if (state.runs > 0) text += " of " + std::to_string(state.runs);
  text += " runs";
  if (const std::size_t failed = failed_count(table))
    text += ", " + std::to_string(failed) + " of them failed";
  if (state.missing.empty()) return text;
  text += "; missing: " + ranges_text(state.missing);
  for (const auto& [number, why] : state.reasons) text += "; " + std::to_string(number) + ": " + why;
  return text + "; go on with: " + state.command;
}

report::Report study_page(const StudyTable& table, const StudyState& state,
                          const std::vector<std::string>& show) {
  report::Report page;
  page.title = "Study " + state.name;
  page.subtitle = "sprung " + state.origin.version + ", robot files " + state.origin.files;
  page.command = state.command;
  report::Section all{"All runs", {summary_of(table, state)}};
  all.tables.push_back(distributions(table));
  if (failed_count(table) > 0) all.tables.push_back(failures(table));
  all.tables.push_back(worst_runs(table));
  page.sections.push_back(std::move(all));
  for (report::Section& section : parameter_sections(table, show))
    page.sections.push_back(std::move(section));
  return page;
}

}  // namespace sprung
