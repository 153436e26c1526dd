#include "tools/lab/campaign/campaign.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>
#include <utility>

#include "signals/quantile.h"

namespace sprung::campaign {
namespace {

Draw twin_of(Draw draw) {
  draw.injections = {Injection{}};
  draw.injections[0].at_seq = 0;
  draw.second_while_clearing = false;
  return draw;
}

bool breaks(const Verdict& verdict, Rule rule) noexcept {
  return std::any_of(verdict.breaches.begin(), verdict.breaches.end(),
                     [&](const Breach& one) { return one.rule == rule; });
}

template <class Is>
double share_of(const std::vector<Verdict>& runs, const Is& is) {
  int judged = 0, count = 0;
  for (const Verdict& one : runs) {
    if (!one.failure.empty()) continue;
    ++judged;
    count += is(one) ? 1 : 0;
  }
  return judged > 0 ? 100.0 * count / judged : kNaN;
}

template <class Is>
int count_of(const std::vector<Verdict>& runs, const Is& is) {
  return static_cast<int>(std::count_if(runs.begin(), runs.end(), is));
}

/// Of those that are known.
double quantile_of(std::vector<double> values, double share) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }),
               values.end());
  return quantile(std::move(values), share);
}

std::vector<report::Cell> group_row(const std::string& name, const std::vector<const Verdict*>& runs) {
  std::vector<double> noticed, safe, fastest, force;
  int tripped = 0, bad_ones = 0;
  for (const Verdict* one : runs) {
    noticed.push_back(1e3 * one->noticed_s);
    safe.push_back(1e3 * one->safe_s);
    fastest.push_back(one->fastest_share);
    force.push_back(one->peak_force_N);
    tripped += one->tripped() ? 1 : 0;
    bad_ones += bad(*one) ? 1 : 0;
  }
  return {name,
          static_cast<int>(runs.size()),
          tripped,
          quantile_of(noticed, 0.5),
          quantile_of(noticed, 0.95),
          quantile_of(safe, 0.5),
          quantile_of(safe, 0.95),
          quantile_of(fastest, 1.0),
          quantile_of(force, 0.5),
          quantile_of(force, 1.0),
          report::Cell(bad_ones, bad_ones == 0 ? report::Mark::kGood : report::Mark::kBad)};
}

template <class Key>
std::map<std::string, std::vector<const Verdict*>> groups_of(const std::vector<Verdict>& runs,
                                                             const Key& key) {
  std::map<std::string, std::vector<const Verdict*>> groups;
  for (const Verdict& one : runs) groups[key(one)].push_back(&one);
  return groups;
}

template <class Key>
report::Table grouped(const std::string& title, const std::vector<Verdict>& runs, const Key& key) {
  report::Table table{title,
                      {"", "runs", "stopped", "noticed, median (ms)", "95 %", "no torque, median (ms)",
                       "95 %", "fastest joint over its limit", "largest force on a foot, median (N)",
                       "largest (N)", "not as it should be"}};
  for (const auto& [name, group] : groups_of(runs, key)) table.rows.push_back(group_row(name, group));
  return table;
}

/// Of the runs that came to rest: the share that had by then.
template <class Key>
report::Plot distribution(const std::string& title, const std::vector<Verdict>& runs, const Key& key) {
  report::Plot plot{title, {"time from the fault to no torque", "s"}, {"share of runs", "%"}};
  for (const auto& [name, group] : groups_of(runs, key)) {
    report::Series series;
    series.name = name;
    for (const Verdict* one : group)
      if (!std::isnan(one->safe_s)) series.x.push_back(one->safe_s);
    std::sort(series.x.begin(), series.x.end());
    for (std::size_t i = 1; i <= series.x.size(); ++i)
      series.y.push_back(100.0 * static_cast<double>(i) / static_cast<double>(series.x.size()));
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

std::string class_of(const Verdict& verdict) { return name(verdict.draw.injections[0].kind); }
std::string state_of(const Verdict& verdict) { return verdict.draw.state; }

}  // namespace

double rule_of_three(std::size_t runs) noexcept {
  return runs > 0 ? std::min(3.0 / static_cast<double>(runs), 1.0) : kNaN;
}

bool bad(const Verdict& verdict) noexcept {
  return !verdict.failure.empty() || !verdict.breaches.empty() || !verdict.cause_expected ||
         !verdict.back_or_explained();
}

bool bad_twin(const Verdict& verdict) noexcept {
  return !verdict.failure.empty() || verdict.tripped() || !verdict.breaches.empty();
}

Result run_campaign(const RobotConfig& robot, const Request& request) {
  if (request.runs < 1) throw std::invalid_argument("--runs must be 1 or more");
  const auto count = static_cast<std::size_t>(request.runs);
  const auto draw = [&](std::size_t i) {
    return draw_run(robot, request.seed, request.first + i, request.only);
  };
  const std::size_t of_each = request.twins ? 2 : 1;
  const auto all = parallel_map(
      of_each * count,
      [&](std::size_t i) {
        const Draw drawn = draw(i / of_each);
        return run_trial(robot, request.preset, i % of_each == 0 ? drawn : twin_of(drawn));
      },
      request.parallel);
  Result out;
  for (std::size_t i = 0; i < all.size(); ++i) (i % of_each == 0 ? out.runs : out.twins).push_back(all[i]);
  return out;
}

std::vector<ReportRow> campaign_rows(const Result& result) {
  const std::vector<Verdict>& runs = result.runs;
  std::vector<ReportRow> rows{row("campaign.all.runs", "", static_cast<double>(runs.size()))};
  for (const auto& word : kWords<Rule>)
    rows.push_back(row(std::string("campaign.all.") + word.name, "",
                       count_of(runs, [&](const Verdict& v) { return breaks(v, word.value); }),
                       at_most(0.0)));
  rows.push_back(row("campaign.all.causes_right", "%",
                     share_of(runs, [](const Verdict& v) { return v.cause_expected; }), at_least(99.0)));
  rows.push_back(row("campaign.all.recovered_or_explained", "%",
                     share_of(runs, [](const Verdict& v) { return v.back_or_explained(); }),
                     at_least(100.0)));
  rows.push_back(
      row("campaign.all.recovered", "%", share_of(runs, [](const Verdict& v) { return v.recovered; })));
  rows.push_back(row("campaign.all.not_judged", "",
                     count_of(runs, [](const Verdict& v) { return !v.failure.empty(); }), at_most(0.0)));
  rows.push_back(row("campaign.none.false_stops", "", count_of(result.twins, bad_twin), at_most(0.0)));
  rows.push_back(row("campaign.all.less_than_at_95_percent", "%", 100.0 * rule_of_three(runs.size())));
  return rows;
}

std::string campaign_command(const std::string& robot, std::uint64_t seed, std::uint64_t first, int runs,
                             Class only) {
  return "sprung campaign --robot " + robot + " --seed " + std::to_string(seed) +
         (first == 0 ? "" : " --first " + std::to_string(first)) + " --runs " + std::to_string(runs) +
         (only == Class::kNone ? "" : std::string(" --only ") + name(only));
}

std::string failure_text(const Verdict& verdict, const RobotConfig& robot, const std::string& asked_robot) {
  const Draw& draw = verdict.draw;
  std::string text = "run " + std::to_string(draw.number) + ", " + draw.state + ":";
  for (std::size_t i = 0; i < draw.injections.size(); ++i)
    text += std::string(i == 0                       ? " "
                        : draw.second_while_clearing ? "; while clearing "
                                                     : "; then ") +
            text_of(draw.injections[i], robot);
  text += "\n ";
  if (!verdict.failure.empty()) text += " not judged: " + verdict.failure + ";";
  for (const Breach& breach : verdict.breaches)
    text += std::string(" ") + name(breach.rule) + ": " + breach.detail + " in cycle " +
            std::to_string(breach.seq) + ";";
  if (!verdict.cause_expected) text += std::string(" cause: ") + name(verdict.cause) + ";";
  if (!verdict.back_or_explained()) text += " neither back nor explained;";
  return text + "\n  " + campaign_command(asked_robot, draw.seed, draw.number, 1, draw.only);
}

namespace {

report::Table explanations(const std::vector<Verdict>& runs) {
  report::Table table{"Why a robot did not stand again", {"what it said", "runs"}};
  std::map<std::string, int> counts;
  for (const Verdict& one : runs)
    if (!one.recovered && one.failure.empty()) ++counts[one.explained.empty() ? "nothing" : one.explained];
  for (const auto& [text, count] : counts) table.rows.push_back({text, count});
  return table;
}

}  // namespace

std::vector<report::Section> campaign_sections(const Result& result, const RobotConfig& robot,
                                               const std::string& asked_robot) {
  report::Section groups{"How soon it was safe"};
  groups.tables = {grouped("By what went wrong", result.runs, class_of),
                   grouped("By what the robot did", result.runs, state_of), explanations(result.runs)};
  groups.plots = {distribution("No torque any more, by what went wrong", result.runs, class_of),
                  distribution("No torque any more, by what the robot did", result.runs, state_of)};
  report::Section failures{"Runs that are not as they should be"};
  for (const Verdict& one : result.runs)
    if (bad(one)) failures.text.push_back(failure_text(one, robot, asked_robot));
  for (const Verdict& one : result.twins)
    if (bad_twin(one)) failures.text.push_back("without a fault: " + failure_text(one, robot, asked_robot));
  if (failures.text.empty()) failures.text.emplace_back("None.");
  return {groups, failures};
}

}  // namespace sprung::campaign
