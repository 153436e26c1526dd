#include "tools/lab/tune/tune_report.h"

#include <algorithm>
#include <string>

namespace sprung {

namespace {

using report::Cell;
using report::number_text;

constexpr std::size_t kBestShown = 10;
constexpr double kPercent = 100.0;

std::string heading(const TuneSpace& space, std::size_t parameter) {
  const std::string unit = space.unit(parameter);
  return space.parameters()[parameter].key + (unit.empty() ? "" : " (" + unit + ")");
}

std::vector<std::string> columns(const TuneSpace& space) {
  std::vector<std::string> names = {"set"};
  for (std::size_t i = 0; i < space.parameters().size(); ++i) names.push_back(heading(space, i));
  for (const char* name : {"motor side (Nm)", "gear output (Nm)", "worst gear output (Nm)",
                           "height error (%)", "upright (%)", "cost"})
    names.emplace_back(name);
  return names;
}

std::vector<Cell> cells(const std::string& name, const TuneCandidate& candidate) {
  std::vector<Cell> cells = {name};
  for (const double value : candidate.values) cells.emplace_back(value);
  const TuneTerms& t = candidate.terms;
  for (const double value : {t.landing_motor_Nm, t.landing_output_Nm, t.worst_landing_output_Nm,
                             kPercent * t.height_error, kPercent * t.upright, candidate.cost})
    cells.emplace_back(value);
  return cells;
}

report::Table best_ten(const TuneSpace& space, const TuneResult& result) {
  report::Table table{"The best ten and the preset as it is, on the plants tuned on", columns(space)};
  const std::vector<std::size_t> order = by_cost(result.candidates);
  for (std::size_t i = 0; i < std::min(kBestShown, order.size()); ++i)
    table.rows.push_back(cells("#" + std::to_string(order[i]), result.candidates[order[i]]));
  table.rows.push_back(cells("present", result.candidates.front()));
  return table;
}

report::Table trade(const TuneSpace& space, const TuneResult& result) {
  report::Table table{"What was traded: no set beats one of these in every column", columns(space)};
  std::vector<TuneTerms> terms;
  for (const TuneCandidate& candidate : result.candidates) terms.push_back(candidate.terms);
  std::vector<std::size_t> front = pareto_front(terms);
  std::stable_sort(front.begin(), front.end(), [&](std::size_t a, std::size_t b) {
    return terms[a].landing_output_Nm < terms[b].landing_output_Nm;
  });
  for (const std::size_t i : front)
    table.rows.push_back(cells("#" + std::to_string(i), result.candidates[i]));
  return table;
}

report::Table reported(const TuneSpace& space, const TuneRequest& request, const TuneResult& result) {
  return {"On " + std::to_string(request.plants) + " plants of seed " + std::to_string(request.seed) +
              ", which were not tuned on",
          columns(space),
          {cells("present", result.present_reported), cells("best", result.best_reported)}};
}

std::string text_of(const report::Table& table) {
  std::vector<std::size_t> widths;
  for (const std::string& column : table.columns) widths.push_back(column.size());
  for (const auto& cells : table.rows)
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].text.size());
  std::string text = table.title + "\n";
  const auto add = [&](const std::string& cell, std::size_t i) {
    text += std::string(widths[i] - cell.size() + (i > 0 ? 2 : 0), ' ') + cell;
  };
  for (std::size_t i = 0; i < widths.size(); ++i) add(table.columns[i], i);
  text += "\n";
  for (const auto& cells : table.rows) {
    for (std::size_t i = 0; i < cells.size(); ++i) add(cells[i].text, i);
    text += "\n";
  }
  return text + "\n";
}

std::string how(const TuneRequest& request, const TuneResult& result) {
  return std::to_string(result.candidates.size()) + " sets of gains, each on " +
         std::to_string(request.plants) + " plants of seed " + std::to_string(request.tune_seed) +
         ". Cost: " + cost_text(request.objective) + ".";
}

/// `indices` of the candidates as a cloud.
report::Series cloud(const std::string& name, const TuneResult& result,
                     const std::vector<std::size_t>& indices, double (*x)(const TuneCandidate&),
                     double (*y)(const TuneCandidate&)) {
  report::Series series{name, {}, {}, report::Style::kPoints};
  for (const std::size_t i : indices) {
    series.x.push_back(x(result.candidates[i]));
    series.y.push_back(y(result.candidates[i]));
  }
  return series;
}

double output_Nm(const TuneCandidate& c) { return c.terms.landing_output_Nm; }
double motor_Nm(const TuneCandidate& c) { return c.terms.landing_motor_Nm; }
double error_percent(const TuneCandidate& c) { return kPercent * c.terms.height_error; }

std::vector<std::size_t> upright_everywhere(const TuneResult& result, bool upright) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < result.candidates.size(); ++i)
    if ((result.candidates[i].terms.upright >= 1.0) == upright) found.push_back(i);
  return found;
}

report::Plot trade_plot(const TuneResult& result, const std::string& title, const report::Axis& x_axis,
                        double (*x)(const TuneCandidate&), const report::Axis& y_axis,
                        double (*y)(const TuneCandidate&)) {
  report::Plot plot{title, x_axis, y_axis};
  plot.series = {cloud("best", result, {result.best}, x, y), cloud("present", result, {0}, x, y),
                 cloud("upright on every plant", result, upright_everywhere(result, true), x, y),
                 cloud("fell on one or more", result, upright_everywhere(result, false), x, y)};
  return plot;
}

report::Plot cost_plot(const TuneSpace& space, const TuneResult& result, std::size_t parameter) {
  const std::string& key = space.parameters()[parameter].key;
  report::Plot plot{"Cost over " + key, {key, space.unit(parameter)}, {"cost", ""}};
  const auto add = [&](const std::string& name, const std::vector<std::size_t>& indices) {
    report::Series series{name, {}, {}, report::Style::kPoints};
    for (const std::size_t i : indices) {
      series.x.push_back(result.candidates[i].values[parameter]);
      series.y.push_back(result.candidates[i].cost);
    }
    plot.series.push_back(series);
  };
  add("best", {result.best});
  add("present", {0});
  add("upright on every plant", upright_everywhere(result, true));
  return plot;
}

void add_rows(std::vector<ReportRow>& rows, const std::string& which, const TuneCandidate& candidate) {
  const TuneTerms& t = candidate.terms;
  const auto add = [&](const char* quantity, const char* unit, double value) {
    rows.push_back(row("tune." + which + "." + quantity, unit, value));
  };
  add("landing_motor_torque", "Nm", t.landing_motor_Nm);
  add("landing_output_torque", "Nm", t.landing_output_Nm);
  add("worst_landing_output_torque", "Nm", t.worst_landing_output_Nm);
  add("height_error", "%", kPercent * t.height_error);
  add("upright", "%", kPercent * t.upright);
  add("cost", "", candidate.cost);
}

}  // namespace

std::string tune_table(const TuneSpace& space, const TuneRequest& request, const TuneResult& result) {
  return how(request, result) + "\n\n" + text_of(best_ten(space, result)) + text_of(trade(space, result)) +
         text_of(reported(space, request, result));
}

std::vector<ReportRow> tune_rows(const TuneSpace& space, const TuneResult& result) {
  std::vector<ReportRow> rows;
  add_rows(rows, "present", result.present_reported);
  add_rows(rows, "best", result.best_reported);
  for (std::size_t i = 0; i < space.parameters().size(); ++i)
    rows.push_back(
        row("tune.best." + space.parameters()[i].key, space.unit(i), result.best_reported.values[i]));
  return rows;
}

std::string tune_fragment(const TuneSpace& space, const TuneRequest& request, const TuneResult& result,
                          const std::string& command) {
  const auto cost = [](const TuneCandidate& c) { return number_text(c.cost); };
  const std::string comment = "By `" + command + "`: cost " + cost(result.present_reported) + " before, " +
                              cost(result.best_reported) + " with these, on plants of seed " +
                              std::to_string(request.seed);
  return space.fragment(result.candidates[result.best].values, comment);
}

std::vector<report::Section> tune_sections(const TuneSpace& space, const TuneRequest& request,
                                           const TuneResult& result) {
  report::Section summary{"Summary", {how(request, result)}, {reported(space, request, result)}};
  report::Section sets{"Sets of gains", {}, {best_ten(space, result), trade(space, result)}};
  const report::Axis output{"peak gear output torque of the knee, landing", "Nm"};
  report::Section traded{"Trade",
                         {"Each point is a set of gains: means over the plants tuned on."},
                         {},
                         {trade_plot(result, "Height against gear output torque", output, output_Nm,
                                     {"height error", "%"}, error_percent),
                          trade_plot(result, "The papers' torque signal against the gear's true output",
                                     output, output_Nm, {"motor-side torque", "Nm"}, motor_Nm)}};
  report::Section costs{"Cost over each parameter"};
  for (std::size_t i = 0; i < space.parameters().size(); ++i)
    costs.plots.push_back(cost_plot(space, result, i));
  return {summary, sets, traded, costs};
}

}  // namespace sprung
