#include "tools/lab/estimation/estimator_experiment.h"

#include <chrono>
#include <cstdio>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "robots/robot_loader.h"
#include "tools/lab/estimation/contact_experiment.h"
#include "tools/lab/estimation/estimator_ensemble.h"
#include "tools/lab/estimation/estimator_jump_rows.h"
#include "tools/lab/estimation/estimator_temperature_rows.h"
#include "tools/lab/friction/friction_sweep.h"
#include "tools/lab/recordings/recording_rows.h"

namespace sprung {
namespace {

void append(ExperimentReport& report, const std::vector<ReportRow>& rows) {
  report.rows.insert(report.rows.end(), rows.begin(), rows.end());
}

void add_contact_rows(const RobotConfig& robot, const EstimatorRequest& request, ExperimentReport& report) {
  ContactRequest contact;
  contact.preset = request.preset;
  for (const EnsemblePlant& plant : estimator_ensemble(request.seed))
    contact.plants.push_back({plant.seed, plant.changes, true});
  append(report, contact_rows(run_contacts(robot, contact)));
}

/// Three plants that differ in their noise, at walking speed.
void add_walking_contact_rows(const RobotConfig& robot, const EstimatorRequest& request,
                              ExperimentReport& report) {
  constexpr std::uint64_t kSeeds = 3;
  for (const auto& [gait, forward_m_s] : {std::pair{"trot", 0.35}, std::pair{"crawl", 0.1}}) {
    std::vector<ContactStep> steps;
    for (std::uint64_t i = 0; i < kSeeds; ++i) {
      const std::vector<ContactStep> more = walking_contacts(
          robot, {request.preset, gait, forward_m_s, 8.0, SimOptions{request.seed + i, {}, true}});
      steps.insert(steps.end(), more.begin(), more.end());
    }
    append(report, walking_contact_rows(gait, steps));
  }
}

void add_friction_rows(const RobotConfig& robot, const EstimatorRequest& request, ExperimentReport& report) {
  append(report,
         friction_fit_rows(robot, request.preset, SimOptions{request.seed, {}, true}, &report.simulated_s));
}

/// Standard output may be JSON, so what is left out is said on the other.
void add_recorded_rows(const EstimatorRequest& request, ExperimentReport& report) {
  const auto folder = recordings::data_folder(request.data);
  if (!folder) {
    std::fprintf(stderr, "no folder of recordings: their rows are left out (--data DIR names one)\n");
    return;
  }
  for (const recordings::RecordingResult& result : recordings::results_of(*folder))
    append(report, recordings::rows_of(result));
}

/// One part of the table, and the robot that it runs on.
struct Section {
  const char* name;
  const char* robot;
  void (*add)(const RobotConfig& robot, const EstimatorRequest& request, ExperimentReport& report);
};

/// A quadruped's own: the table of test_axis is about joints and a single leg.
constexpr const char* kWalkingContact = "walking_contact";

constexpr Section kSections[] = {
    {"jump", "single_leg",
     [](const RobotConfig& robot, const EstimatorRequest& r, ExperimentReport& report) {
       add_jump_rows(robot, r.preset, r.seed, report);
     }},
    {"bounds", "single_leg",
     [](const RobotConfig& robot, const EstimatorRequest& r, ExperimentReport& report) {
       add_bounds_rows(robot, r.preset, r.seed, report);
     }},
    {"contact", "single_leg", add_contact_rows},
    {"temperature", "test_axis",
     [](const RobotConfig& robot, const EstimatorRequest& r, ExperimentReport& report) {
       add_temperature_rows(robot, r.preset, r.seed, report);
     }},
    {"friction_fit", "pegasus", add_friction_rows},
    {kWalkingContact, "pegasus", add_walking_contact_rows},
    {"recordings", "test_axis",
     [](const RobotConfig&, const EstimatorRequest& r, ExperimentReport& report) {
       add_recorded_rows(r, report);
     }},
};

constexpr const char* kWholeTable = "test_axis";

/// The robot's own, or the whole table. @param only "" = all.
std::vector<const Section*> sections_of(const RobotConfig& robot, const std::string& only) {
  std::vector<const Section*> out;
  for (const Section& section : kSections) {
    const bool own = robot.name == section.robot;
    const bool in_table = robot.name == kWholeTable && std::string_view(section.name) != kWalkingContact;
    if ((only.empty() || only == section.name) && (own || in_table)) out.push_back(&section);
  }
  return out;
}

}  // namespace

std::string estimator_sections() {
  std::string text;
  std::string last;
  for (const Section& section : kSections) {
    if (section.name == last) continue;  // the same of another robot
    last = section.name;
    text += (text.empty() ? "" : ", ") + last;
  }
  return text;
}

ExperimentReport run_estimator_experiment(const EstimatorRequest& request,
                                          const SectionProgress& on_progress) {
  ExperimentReport report;
  const RobotConfig named = load_robot(request.robot);
  report.experiment = "estimator";
  report.robot = named.name;
  report.preset = named.preset(request.preset).name;
  report.seed = request.seed;
  const auto started = std::chrono::steady_clock::now();
  const std::vector<const Section*> sections = sections_of(named, request.only);
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (on_progress) on_progress(i, sections.size());
    const bool own = named.name == sections[i]->robot;
    sections[i]->add(own ? named : load_robot(sections[i]->robot), request, report);
  }
  if (report.rows.empty() && request.only != "recordings")
    throw std::invalid_argument("no rows of " + named.name + " in '" + request.only +
                                "'; sections: " + estimator_sections());
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return report;
}

}  // namespace sprung
