#include "tools/lab/estimation/estimator_experiment.h"

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "robots/robot_loader.h"
#include "tools/lab/estimation/contact_experiment.h"
#include "tools/lab/estimation/estimator_ensemble.h"
#include "tools/lab/estimation/estimator_rows.h"
#include "tools/lab/estimation/walking_estimate.h"
#include "tools/lab/friction/friction_sweep.h"
#include "tools/lab/gait/walk_experiment.h"
#include "tools/lab/recordings/recording_rows.h"

namespace sprung {
namespace {

struct EstimatorRequest {
  std::string preset{};  ///< of each robot; empty = its usual one
  SimOptions sim{};      ///< of --seed and --plant
  std::uint64_t ensemble = 1;
  std::string data{};  ///< folder of recordings; "" = /work/shared/data or ../shared/data where one is
  std::string only{};  ///< "" = all; else one section
};

void append(ExperimentOutput& part, const std::vector<ReportRow>& rows) {
  part.rows.insert(part.rows.end(), rows.begin(), rows.end());
}

void add_contact_rows(const RobotConfig& robot, const EstimatorRequest& request, ExperimentOutput& part) {
  ContactRequest contact;
  contact.preset = request.preset;
  for (const EnsemblePlant& plant : estimator_plants(request.sim, request.ensemble))
    contact.plants.push_back({plant.seed, plant.changes, true});
  append(part, contact_rows(run_contacts(robot, contact)));
}

double speed_in_walk(const RobotConfig& robot, const std::string& gait) {
  for (const GaitCase& one : gait_cases(robot))
    if (one.name == gait) return one.speed_m_s;
  throw std::invalid_argument("'" + gait + "' is no case of walk");
}

/// Three plants that differ in their noise, at the speeds of `walk`.
void add_walking_rows(const RobotConfig& robot, const EstimatorRequest& request, ExperimentOutput& part) {
  constexpr std::uint64_t kSeeds = 3;
  for (const std::string gait : {"trot", "crawl"}) {
    const double forward_m_s = speed_in_walk(robot, gait);
    WalkingEstimate found;
    for (std::uint64_t i = 0; i < kSeeds; ++i) {
      SimOptions sim = request.sim;
      sim.seed += i;
      found.add(walking_estimate(robot, {request.preset, gait, forward_m_s, 8.0, sim}));
    }
    append(part, walking_estimate_rows(gait, found));
  }
}

void add_friction_rows(const RobotConfig& robot, const EstimatorRequest& request, ExperimentOutput& part) {
  append(part,
         friction_fit_rows(robot, request.preset, SimOptions{request.sim.seed, {}, true}, &part.simulated_s));
}

/// Standard output may be JSON, so what is left out is said on the other.
void add_recorded_rows(const EstimatorRequest& request, ExperimentOutput& part) {
  const auto folder = recordings::data_folder(request.data);
  if (!folder) {
    std::fprintf(stderr, "no folder of recordings: their rows are left out (--data DIR names one)\n");
    return;
  }
  for (const recordings::RecordingResult& result : recordings::results_of(*folder))
    append(part, recordings::rows_of(result));
}

/// Whose own a part is, besides the robot's that it names.
enum class Kind { kThatRobot, kLeg, kWalker };

bool is_a(Kind kind, const RobotConfig& robot) {
  if (kind == Kind::kWalker) return !robot.gaits.empty();
  return kind == Kind::kLeg && robot.gaits.empty() && robot.why_not_standing() == nullptr;
}

/// One part of the table, and the robot that it runs on.
struct Section {
  const char* name;
  const char* robot;
  Kind kind;
  void (*add)(const RobotConfig& robot, const EstimatorRequest& request, ExperimentOutput& part);
  bool changed = false;  ///< also on a changed plant
};

/// A quadruped's own: the table of test_axis is about joints and a single leg.
constexpr const char* kWalkingContact = "walking_contact";

constexpr Section kSections[] = {
    {"jump", "single_leg", Kind::kLeg,
     [](const RobotConfig& robot, const EstimatorRequest& r, ExperimentOutput& part) {
       add_jump_rows(robot, r.preset, r.sim, part);
     },
     true},
    {"bounds", "single_leg", Kind::kLeg,
     [](const RobotConfig& robot, const EstimatorRequest& r, ExperimentOutput& part) {
       add_bounds_rows(robot, r.preset, r.sim, r.ensemble, part);
     },
     true},
    {"contact", "single_leg", Kind::kLeg, add_contact_rows, true},
    {"temperature", "test_axis", Kind::kThatRobot,
     [](const RobotConfig& robot, const EstimatorRequest& r, ExperimentOutput& part) {
       add_temperature_rows(robot, r.preset, r.sim.seed, part);
     }},
    {"friction_fit", "pegasus", Kind::kThatRobot, add_friction_rows},
    {kWalkingContact, "pegasus", Kind::kWalker, add_walking_rows, true},
    {"recordings", "test_axis", Kind::kThatRobot,
     [](const RobotConfig&, const EstimatorRequest& r, ExperimentOutput& part) {
       add_recorded_rows(r, part);
     }},
};

constexpr const char* kWholeTable = "test_axis";

bool owns(const RobotConfig& robot, const Section& section) {
  return robot.name == section.robot || is_a(section.kind, robot);
}

/// The robot's own, or the whole table; on a changed plant the robot's own that can be. @param only "" = all.
std::vector<const Section*> sections_of(const RobotConfig& robot, const std::string& only, bool changed) {
  std::vector<const Section*> out;
  for (const Section& section : kSections) {
    const bool own = owns(robot, section);
    const bool in_table = robot.name == kWholeTable && std::string_view(section.name) != kWalkingContact;
    if (changed && !(own && section.changed)) continue;
    if ((only.empty() || only == section.name) && (own || in_table)) out.push_back(&section);
  }
  return out;
}

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

ExperimentOutput run_estimator(const ExperimentInput& in, EstimatorRequest request) {
  request.preset = in.asked.preset;
  request.sim = in.sim;
  const bool changed = !in.sim.plant.empty();
  const std::vector<const Section*> sections = sections_of(in.robot, request.only, changed);
  ExperimentOutput out;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    if (in.parallel.on_progress) in.parallel.on_progress(i, sections.size());
    const bool own = owns(in.robot, *sections[i]);
    sections[i]->add(own ? in.robot : load_robot(sections[i]->robot), request, out);
  }
  if (out.rows.empty() && request.only != "recordings")
    throw std::invalid_argument("no rows of " + in.robot.name + " in '" + request.only + "'; " +
                                (changed ? "with --plant or --plants there are jump, bounds and contact of "
                                           "single_leg, walking_contact of pegasus"
                                         : "sections: " + estimator_sections()));
  return out;
}

}  // namespace

Experiment estimator_experiment() {
  const auto own = std::make_shared<EstimatorRequest>();
  Experiment out;
  out.name = "estimator";
  out.what = "What the torque estimate is worth: against the simulation's truth and against recordings.";
  out.question =
      "How far off is the estimated torque in jumps, at rest and over temperature, and how soon is a contact "
      "noticed?";
  out.robot = kWholeTable;
  out.robot_help = "test_axis: the whole table, with the robots that it needs; another robot: its own rows";
  out.preset_note = "; of the jumps";
  out.takes = {Common::kPreset, Common::kPlant, Common::kOut};
  out.seed_help = "of every noise; 0 was used for tuning";
  out.example = "--robot test_axis --seed 1 --json";
  out.in_all = {RobotKind::kJoint, RobotKind::kLeg, RobotKind::kWalker};
  out.own.option("--data", own->data, "folder of recordings; default ../shared/data where it is");
  out.own.option("--only", own->only, "one part of the table: " + estimator_sections());
  out.own.option("--ensemble", own->ensemble,
                 "which plants are drawn about sim.yaml's; 0 was used for tuning");
  out.run = [own](const ExperimentInput& in) { return run_estimator(in, *own); };
  return out;
}

}  // namespace sprung
