#include "tools/experiments/estimator_experiment.h"

#include <chrono>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "tools/experiments/estimator_jump_rows.h"

namespace sprung {
namespace {

/// One part of the table: the robot that it runs on, "" = none (recordings).
struct Section {
  const char* name;
  const char* robot;
  void (*add)(const RobotConfig& robot, const EstimatorRequest& request, ExperimentReport& report);
};

constexpr Section kSections[] = {
    {"jump", "single_leg",
     [](const RobotConfig& robot, const EstimatorRequest& r, ExperimentReport& report) {
       add_jump_rows(robot, r.preset, r.seed, report);
     }},
    {"bounds", "single_leg",
     [](const RobotConfig& robot, const EstimatorRequest& r, ExperimentReport& report) {
       add_bounds_rows(robot, r.preset, r.seed, report);
     }},
};

constexpr const char* kWholeTable = "test_axis";

}  // namespace

std::string estimator_sections() {
  std::string text;
  for (const Section& section : kSections) text += (text.empty() ? "" : ", ") + std::string(section.name);
  return text;
}

ExperimentReport run_estimator_experiment(const EstimatorRequest& request) {
  ExperimentReport report;
  const RobotConfig named = load_robot(request.robot);
  report.experiment = "estimator";
  report.robot = named.name;
  report.preset = request.preset;
  report.seed = request.seed;
  const auto started = std::chrono::steady_clock::now();
  for (const Section& section : kSections) {
    if (!request.only.empty() && request.only != section.name) continue;
    if (named.name == section.robot) {
      section.add(named, request, report);
    } else if (named.name == kWholeTable) {
      section.add(load_robot(section.robot), request, report);
    }
  }
  if (report.rows.empty())
    throw std::invalid_argument("no rows of " + named.name + " in '" + request.only +
                                "'; sections: " + estimator_sections());
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return report;
}

}  // namespace sprung
