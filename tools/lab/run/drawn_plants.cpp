#include "tools/lab/run/drawn_plants.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "signals/quantile.h"
#include "simulation/plant/plant_draw.h"
#include "tools/common/parallel.h"

namespace sprung {
namespace {

struct Seen {
  ReportRow row;
  std::uint64_t draw = 0;
};

/// Rows of one name, in the order of the draws.
struct Named {
  std::string name;
  std::vector<Seen> seen;
};

std::vector<Named> by_name(const std::vector<DrawnRows>& draws) {
  std::vector<Named> all;
  for (const DrawnRows& draw : draws) {
    for (const ReportRow& row : draw.rows) {
      auto found = std::find_if(all.begin(), all.end(),
                                [&](const Named& one) { return one.name == row.name; });
      if (found == all.end()) found = all.insert(all.end(), {row.name, {}});
      found->seen.push_back({row, draw.draw});
    }
  }
  return all;
}

void add_one(std::vector<ReportRow>& rows, const std::string& name, const Seen& one, bool with_bounds) {
  ReportRow value = one.row;
  value.name = one.row.name + "." + name;
  value.paper.reset();
  if (!with_bounds) value.low = value.high = std::nullopt;
  rows.push_back(value);
  rows.push_back(row(value.name + "_draw", "", static_cast<double>(one.draw)));
}

void add_distribution(std::vector<ReportRow>& rows, const Named& named) {
  std::vector<double> values;
  for (const Seen& one : named.seen) {
    if (!std::isnan(one.row.value)) values.push_back(one.row.value);
  }
  const ReportRow& first = named.seen.front().row;
  const double median = values.empty() ? std::nan("") : quantile(values, 0.5);
  rows.push_back(row(named.name + ".median", first.unit, median));
  if (first.low || first.high) {
    const auto worst = std::max_element(
        named.seen.begin(), named.seen.end(),
        [](const Seen& a, const Seen& b) { return a.row.excess() < b.row.excess(); });
    const auto met = std::count_if(named.seen.begin(), named.seen.end(),
                                   [](const Seen& one) { return one.row.excess() <= 0.0; });
    rows.push_back(row(named.name + ".met", "%",
                       100.0 * static_cast<double>(met) / static_cast<double>(named.seen.size())));
    return add_one(rows, "worst", *worst, true);
  }
  if (values.empty()) return;
  const auto less = [](const Seen& a, const Seen& b) { return a.row.value < b.row.value; };
  std::vector<Seen> reached;
  for (const Seen& one : named.seen) {
    if (!std::isnan(one.row.value)) reached.push_back(one);
  }
  add_one(rows, "least", *std::min_element(reached.begin(), reached.end(), less), false);
  add_one(rows, "most", *std::max_element(reached.begin(), reached.end(), less), false);
}

struct OneDraw {
  DrawnRows rows;
  double simulated_s = 0.0;
};

OneDraw run_one(const Experiment& experiment, ExperimentInput input, const SimOptions& plant) {
  OneDraw out;
  out.rows.draw = static_cast<std::uint64_t>(plant.plant.at("draw"));
  input.sim = plant;
  input.asked.pages = false;
  input.parallel = {1, {}};
  try {
    const ExperimentOutput said = experiment.run(input);
    out.rows.rows = said.rows;
    out.simulated_s = said.simulated_s;
  } catch (const std::exception& error) {
    out.rows.failure = error.what();
  }
  return out;
}

std::string said_of(const ExperimentInput& input, const std::vector<OneDraw>& draws) {
  std::string family = "of sim.yaml's friction";
  for (const auto& change : input.sim.plant) {
    if (change.first.rfind(sim::kFamilyKey, 0) == 0)
      family = "of friction " + change.first.substr(std::string(sim::kFamilyKey).size());
  }
  std::string text = "Plants " + std::to_string(draws.front().rows.draw) + " to " +
                     std::to_string(draws.back().rows.draw) + " of " + input.robot.name +
                     "'s variation.yaml, " + family + "; the noise has seed " +
                     std::to_string(input.sim.seed) + " on each: the plant was varied, the seed was not.\n";
  for (const OneDraw& one : draws) {
    if (!one.rows.failure.empty())
      text += "draw " + std::to_string(one.rows.draw) + " has no rows: " + one.rows.failure + "\n";
  }
  return text;
}

}  // namespace

std::vector<SimOptions> drawn_plants(const SimOptions& base, int count) {
  if (count < 1) throw std::invalid_argument("--plants: expected 1 or more, found " + std::to_string(count));
  const auto asked = base.plant.find("draw");
  const double first = asked == base.plant.end() ? 1.0 : asked->second;
  std::vector<SimOptions> plants(static_cast<std::size_t>(count), base);
  for (std::size_t i = 0; i < plants.size(); ++i) plants[i].plant["draw"] = first + static_cast<double>(i);
  return plants;
}

std::vector<ReportRow> distribution_rows(const std::vector<DrawnRows>& draws) {
  std::vector<ReportRow> rows;
  for (const Named& named : by_name(draws)) add_distribution(rows, named);
  return rows;
}

ExperimentOutput run_on_drawn_plants(const Experiment& experiment, const ExperimentInput& input) {
  const std::vector<SimOptions> plants = drawn_plants(input.sim, input.asked.plants);
  const std::vector<OneDraw> draws = parallel_map(
      plants.size(), [&](std::size_t i) { return run_one(experiment, input, plants[i]); }, input.parallel);
  ExperimentOutput out;
  std::vector<DrawnRows> rows;
  double failed = 0.0;
  for (const OneDraw& one : draws) {
    rows.push_back(one.rows);
    out.simulated_s += one.simulated_s;
    if (!one.rows.failure.empty()) ++failed;
  }
  out.before = said_of(input, draws);
  if (failed == static_cast<double>(draws.size())) throw std::runtime_error(out.before);
  out.rows = {row(experiment.name + ".plants.drawn", "", static_cast<double>(draws.size())),
              row(experiment.name + ".plants.without_rows", "", failed, at_most(0.0))};
  const std::vector<ReportRow> distribution = distribution_rows(rows);
  out.rows.insert(out.rows.end(), distribution.begin(), distribution.end());
  return out;
}

}  // namespace sprung
