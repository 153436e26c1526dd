#include "tools/lab/commission/commission_experiment.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include "robots/robot_loader.h"
#include "simulation/plant/sim_config.h"
#include "tools/can/commission/walk.h"
#include "tools/can/decode/bus_description.h"

namespace sprung {
namespace {

std::vector<Mistake> all_mistakes() {
  std::vector<Mistake> all;
  for (const auto& word : kWords<Mistake>)
    if (word.value != Mistake::kNone) all.push_back(word.value);
  return all;
}

/// Every kind once in a drawn order, then again in another one.
std::vector<Mistake> drawn_mistakes(int count, Dice& dice) {
  std::vector<Mistake> out;
  while (static_cast<int>(out.size()) < count) {
    std::vector<Mistake> left = all_mistakes();
    while (!left.empty() && static_cast<int>(out.size()) < count) {
      const std::size_t chosen = dice.below(left.size());
      out.push_back(left[chosen]);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(chosen));
    }
  }
  return out;
}

bool possible_on(const RobotConfig& robot, Mistake mistake) {
  return std::all_of(robot.actuators.begin(), robot.actuators.end(),
                     [&](const ActuatorConfig& actuator) { return possible(mistake, actuator); });
}

double count_if_rows(const std::vector<CommissionOutcome>& outcomes, bool with_mistake, bool right) {
  return static_cast<double>(
      std::count_if(outcomes.begin(), outcomes.end(), [&](const CommissionOutcome& one) {
        return (one.mistake != Mistake::kNone) == with_mistake && one.right() == right;
      }));
}

std::vector<ReportRow> rows_of(const std::vector<CommissionOutcome>& outcomes) {
  double torque = 0.0, motion_rad = 0.0;
  for (const CommissionOutcome& one : outcomes) {
    if (one.mistake == Mistake::kNone) continue;
    torque = std::max(torque, one.torque_share);
    motion_rad = std::max(motion_rad, one.motion_rad);
  }
  const double drawn = count_if_rows(outcomes, true, true) + count_if_rows(outcomes, true, false);
  return {
      row("commission.mistakes.drawn", "", drawn),
      row("commission.mistakes.found", "", count_if_rows(outcomes, true, true), at_least(drawn)),
      row("commission.mistakes.highest_torque", "x breakaway", torque, at_most(kTorqueShare)),
      row("commission.mistakes.largest_motion", "rad", motion_rad, at_most(kMotion_rad)),
      row("commission.right_drives.passed", "", count_if_rows(outcomes, false, true)),
      row("commission.right_drives.false_alarms", "", count_if_rows(outcomes, false, false), at_most(0.0))};
}

std::string table_text(const std::vector<CommissionOutcome>& outcomes) {
  std::string text =
      "| mistake | drawn | drive | found at step | torque, x breakaway | motion, rad "
      "|\n|---|---|---|---|---|---|\n";
  for (const CommissionOutcome& one : outcomes) {
    if (one.mistake == Mistake::kNone && one.right()) continue;
    char numbers[64];
    std::snprintf(numbers, sizeof numbers, "%.2f | %.4f", one.torque_share, one.motion_rad);
    text += std::string("| ") + name(one.mistake) + " | " + one.detail + " | " + one.robot + " " + one.drive +
            " | " + (one.found_at.empty() ? "NOT FOUND" : one.found_at) + " | " + numbers + " |\n";
  }
  return text;
}

std::vector<report::Section> sections_of(const std::vector<CommissionOutcome>& outcomes) {
  report::Section section{"Mistakes"};
  report::Table table{"",
                      {"mistake", "drawn", "drive", "found at step", "torque (x breakaway)", "motion (rad)"}};
  for (const CommissionOutcome& one : outcomes) {
    const report::Mark mark = one.right() ? report::Mark::kGood : report::Mark::kBad;
    table.rows.push_back({name(one.mistake), one.detail, one.robot + " " + one.drive,
                          report::Cell(one.found_at.empty() ? "none" : one.found_at, mark),
                          report::hundredths(one.torque_share), one.motion_rad});
  }
  section.tables.push_back(table);
  return {section};
}

}  // namespace

bool CommissionOutcome::right() const {
  if (mistake == Mistake::kNone) return protocol.ok();
  return !found_at.empty();
}

CommissionOutcome run_commission_case(const CommissionCase& drawn) {
  commission::SimulatedBench bench(drawn.machine, drawn.setup);
  if (drawn.prepare) drawn.prepare(bench);
  const DriveTiming timing = cantools::drive_timing(drawn.believed, drawn.believed.watchdogs);
  CommissionOutcome out;
  out.robot = drawn.believed.name;
  out.drive = drawn.believed.actuators[static_cast<std::size_t>(drawn.actuator)].name;
  out.mistake = drawn.mistake;
  out.detail = drawn.detail;
  out.protocol = commission::Walk(drawn.believed, drawn.actuator, timing, {}, bench, bench).run();
  out.found_at = out.protocol.first_difference();
  const sim::SimConfig truth = sim::load_sim_config(drawn.machine, drawn.setup.sim.plant);
  out.torque_share = bench.truth().highest_torque_Nm /
                     truth.plant.joints[static_cast<std::size_t>(drawn.setup.joint)].friction.breakaway_Nm;
  out.motion_rad = bench.truth().largest_motion_rad;
  out.simulated_s = bench.truth().simulated_s;
  return out;
}

std::vector<CommissionOutcome> run_commission_cases(const std::vector<RobotConfig>& robots,
                                                    std::uint64_t seed, int count,
                                                    const ParallelOptions& parallel) {
  Dice dice(seed);
  std::vector<CommissionCase> cases;
  const std::vector<Mistake> mistakes = drawn_mistakes(count, dice);
  for (int i = 0; i < 2 * count; ++i) {
    const Mistake mistake = i < count ? mistakes[static_cast<std::size_t>(i)] : Mistake::kNone;
    std::vector<const RobotConfig*> fit;
    for (const RobotConfig& robot : robots)
      if (possible_on(robot, mistake)) fit.push_back(&robot);
    if (fit.empty()) continue;
    cases.push_back(
        draw_case(*fit[dice.below(fit.size())], mistake, seed * 1000 + static_cast<std::uint64_t>(i), dice));
  }
  return parallel_map(
      cases.size(), [&](std::size_t i) { return run_commission_case(cases[i]); }, parallel);
}

Experiment commission_experiment() {
  struct Own {
    int cases = 30;
    std::string with = "pegasus";
    bool markdown = false;
  };
  const auto own = std::make_shared<Own>();
  Experiment out;
  out.name = "commission";
  out.what =
      "Drives with drawn mistakes of wiring and setting, and as many right ones, walked through by "
      "`sprung drive commission`.";
  out.question = "Is every mistake found before it can do harm, and is no right drive refused?";
  out.seed_help = "of the draws and of every noise";
  out.takes = {Common::kJobs, Common::kOut, Common::kReport};
  out.many_cases = true;
  out.example = "--seed 1 --markdown";
  out.own.option("--cases", own->cases, "mistakes, and as many right drives");
  out.own.option("--with", own->with, "a second robot, of another make of drive; empty: none");
  out.own.flag("--markdown", own->markdown, "the table of docs/commissioning.md");
  out.run = [own](const ExperimentInput& in) {
    std::vector<RobotConfig> robots = {in.robot};
    if (!own->with.empty()) robots.push_back(load_robot(own->with));
    const std::vector<CommissionOutcome> outcomes = run_commission_cases(robots, in.asked.seed, own->cases,
                                                                         in.parallel);
    ExperimentOutput output{rows_of(outcomes)};
    for (const CommissionOutcome& one : outcomes) output.simulated_s += one.simulated_s;
    output.before = table_text(outcomes);
    if (own->markdown) output.instead = table_text(outcomes);
    output.sections = sections_of(outcomes);
    return output;
  };
  return out;
}

}  // namespace sprung
