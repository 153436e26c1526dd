#include "tools/lab/bring_up/bring_up.h"

#include <stdlib.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "robots/known_weight.h"
#include "robots/robot_loader.h"
#include "runtime/session_clock.h"
#include "runtime/utc_text.h"
#include "simulation/plant/plant_draw.h"
#include "simulation/plant/sim_config.h"
#include "tools/lab/bring_up/never_identified.h"
#include "tools/lab/identify/drive_series.h"
#include "tools/lab/identify/fragment.h"
#include "tools/lab/identify/identify_recording.h"
#include "tools/lab/identify/record_in_process.h"
#include "tools/lab/identify/record_log.h"
#include "tools/lab/run/experiments.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr double kCold_degC = 24.0, kWarm_degC = 40.0;
constexpr std::size_t kDateLetters = 10;

struct BringUpRequest {
  std::string family;  ///< of the plant's friction
  std::string folder;  ///< where the identified robot is written; empty: a temporary one
  std::string only;    ///< one experiment of those that score
};

/// Files of this process alone, gone with it.
class OwnFolder {
 public:
  OwnFolder() : path_(fs::temp_directory_path() / "sprung-bring-up-XXXXXX") {
    std::string text = path_.string();
    if (mkdtemp(text.data()) == nullptr) throw std::runtime_error(text + ": cannot be made");
    path_ = text;
  }
  ~OwnFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

std::string today() { return utc_text(utc_us()).substr(0, kDateLetters); }

/// A drive whose own loop follows set-points quicker than they come has a torque that ripples with the cycle,
/// and its current at SYNC is not the mean: on an erob_50's knee that took all viscous friction away.
RobotConfig with_loops_of_host(RobotConfig robot) {
  for (ActuatorConfig& actuator : robot.actuators) actuator.position_loop = PositionLoopSide::kHost;
  return robot;
}

/// Of the joint's drive, read to a volt.
double voltmeter_V(const RobotConfig& robot, const SimOptions& sim, int joint) {
  return std::round(sim::load_sim_config(robot, sim.plant).drives[static_cast<std::size_t>(joint)].supply_V);
}

/// In the room where the robot is to work, read to a kelvin.
double thermometer_C(const RobotConfig& robot, const SimOptions& sim) {
  return std::round(sim::load_sim_config(robot, sim.plant).plant.ambient_degC);
}

identify::RobotChange bring_up_joint(const RobotConfig& robot, const SimOptions& sim, int joint,
                                     const BringUpProtocol& protocol) {
  const OwnFolder folder;
  std::vector<identify::DriveRecording> recordings;
  std::vector<std::string> files;
  for (const BringUpPass& pass : bring_up_passes(robot, joint)) {
    SimOptions now = sim;
    now.seed += recordings.size();  // another day: other noise
    now.plant["temperature"] = pass.temperature_degC;
    identify::RecordOptions options = protocol.recording;
    options.foot_weight_kg = pass.foot_weight_kg;
    options.loaded = true;
    recordings.push_back({identify::record_in_process(with_loops_of_host(robot), now, joint, options).states,
                          pass.foot_weight_kg, pass.temperature_degC});
    files.push_back(folder / (robot.joints[joint].name + std::to_string(files.size()) + ".lcm"));
    identify::write_drive_log(files.back(), recordings.back().states);
  }
  identify::ProtocolRequest request;
  request.models = protocol.models;
  const identify::IdentifiedJoint found = identify::identify_drives(robot, joint, recordings, request);
  identify::Provenance provenance{std::to_string(files.size()) + " guided recordings",
                                  identify::short_sha256(files), today(), protocol.command};
  provenance.temperature_C = recordings.front().temperature_C;
  provenance.supply_V = voltmeter_V(robot, sim, joint);
  identify::OtherDays days;
  days.ambient_C = thermometer_C(robot, sim);
  return identify::change_of(robot, found, provenance, days);
}

/// What scores a robot: of a leg its estimate, contact, foot return and landings, of a walker its gaits too.
std::vector<std::string> scoring_experiments(const RobotConfig& robot) {
  if (!robot.gaits.empty()) return {"model_watch", "estimator", "foot_return", "walk"};
  if (robot.has_feet() && robot.why_not_standing() == nullptr)
    return {"model_watch", "estimator", "foot_return", "drop"};
  return {"model_watch", "drag"};
}

/// Rows of one experiment on this robot; what it did not reach is a row too, so that a robot that falls over
/// does not end the comparison. @param who it is, should it fail.
std::vector<ReportRow> scored(const std::string& name, const RobotConfig& robot, const ExperimentInput& in,
                              const std::string& who) {
  for (const Experiment& experiment : experiments()) {
    if (experiment.name != name) continue;
    ExperimentInput own = in;
    own.robot = robot;
    own.preset = preset_or(robot, experiment.presets.alone);
    own.asked.preset = own.preset;
    std::vector<ReportRow> rows;
    try {
      rows = experiment.run(own).rows;
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s%s: %s\n", who.c_str(), name.c_str(), error.what());
      rows.push_back(row(name + ".completed", "", 0.0, at_least(1.0)));
    }
    return rows;
  }
  throw std::invalid_argument("there is no experiment '" + name + "'");
}

void append(std::vector<ReportRow>& rows, const std::string& prefix, std::vector<ReportRow> more) {
  for (ReportRow& one : more) {
    one.name.insert(0, prefix);
    rows.push_back(std::move(one));
  }
}

/// The robot as `sprung robot new` gives it: what was identified is of the one that it was copied from. The
/// same without that is mistaken for one whose own gears were recorded: motion alone can tell.
RobotConfig as_shipped(RobotConfig robot) {
  for (JointConfig& joint : robot.joints)
    if (joint.friction) joint.friction->record.robot = "the shipped " + robot.name;
  return robot;
}

/// Of who takes the shipped law for its own gears' nothing is demanded: motion alone can tell, in its time.
std::vector<ReportRow> without_demands(std::vector<ReportRow> rows) {
  for (ReportRow& one : rows) one.low = one.high = std::nullopt;
  return rows;
}

void add_law_rows(const std::vector<identify::RobotChange>& changes, std::vector<ReportRow>& rows) {
  for (const identify::RobotChange& change : changes) {
    const std::string name = "bring_up.joint." + change.joint.name + ".";
    rows.push_back(row(name + "held_out_r2", "", change.joint.friction->record.held_out_r2));
    rows.push_back(row(name + "armature", "kg m^2", change.joint.armature_kg_m2));
    rows.push_back(row(name + "uncertainty_friction", "", change.joint.uncertainty.friction));
    rows.push_back(row(name + "load_share", "", change.joint.friction->parameters.load_share_driving));
  }
}

ExperimentOutput run_bring_up(const ExperimentInput& asked, const BringUpRequest& request) {
  ExperimentInput in = asked;
  if (!request.family.empty()) in.sim.plant.emplace(sim::kFamilyKey + request.family, 1.0);
  in.sim.plant.emplace("draw", static_cast<double>(in.sim.seed));
  BringUpProtocol protocol;
  protocol.command = in.command;
  const std::vector<identify::RobotChange> changes = bring_up_joints(in.robot, in.sim, protocol, in.parallel);
  const OwnFolder own;
  const std::string folder = request.folder.empty() ? own / in.robot.name : request.folder;
  identify::write_identified_robot(in.robot, changes, folder);
  const RobotConfig identified = load_robot(folder);
  ExperimentOutput out;
  add_law_rows(changes, out.rows);
  for (const std::string& name : scoring_experiments(in.robot)) {
    if (!request.only.empty() && request.only != name) continue;
    const std::string ours = "bring_up.identified.", shipped = "bring_up.shipped.",
                      mistaken = "bring_up.mistaken.";
    append(out.rows, ours, scored(name, identified, in, ours));
    append(out.rows, shipped, never_identified(scored(name, as_shipped(in.robot), in, shipped)));
    if (name == "model_watch")
      append(out.rows, mistaken, without_demands(scored(name, in.robot, in, mistaken)));
  }
  return out;
}

}  // namespace

/// Each has the load's share. The one-standard-error rule would do without it on an erob_100's knee, and
/// push-offs were 5.2 instead of 3.5 Nm off; on gears that have none it costs 0.4 Nm. And nearly each has
/// what warmth does: a law of both temperatures at once holds at neither.
const char* const BringUpProtocol::kModels =
    "viscous+load+load_gain,viscous+stribeck+load+asymmetry+load_gain,viscous+load+temperature+load_gain,"
    "viscous+load+asymmetry+temperature+load_gain,viscous+stribeck+load+temperature+load_gain,"
    "viscous+stribeck+load+asymmetry+temperature+load_gain,viscous+load+presliding+temperature+load_gain,"
    "viscous+stribeck+load+asymmetry+presliding+temperature+load_gain";

std::vector<BringUpPass> bring_up_passes(const RobotConfig& robot, int joint) {
  const double weight_kg = known_weight_kg(robot, joint);
  if (!(weight_kg > 0.0)) return {{0.0, kCold_degC}, {0.0, kWarm_degC}};
  return {{0.0, kCold_degC}, {weight_kg, kCold_degC}, {weight_kg, kWarm_degC}};
}

std::vector<identify::RobotChange> bring_up_joints(const RobotConfig& robot, const SimOptions& sim,
                                                   const BringUpProtocol& protocol,
                                                   const ParallelOptions& parallel) {
  return parallel_map(
      robot.joints.size(),
      [&](std::size_t j) { return bring_up_joint(robot, sim, static_cast<int>(j), protocol); }, parallel);
}

Experiment bring_up_experiment() {
  const auto own = std::make_shared<BringUpRequest>();
  Experiment out;
  out.name = "bring_up";
  out.what =
      "A robot with gears that nobody knows is recorded joint by joint with and without a known weight, "
      "identified and scored, beside robot.yaml as shipped.";
  out.question = "Is what a robot team identifies good enough on a gear that is none of ours?";
  out.takes = {Common::kPlant, Common::kJobs, Common::kOut};
  out.seed_help = "of the drawn plant and of every noise";
  out.example = "--robot single_leg --family erob_100 --seed 1";
  out.many_cases = out.reads_files = true;
  out.in_all = {RobotKind::kLeg, RobotKind::kWalker};
  out.shorten = [own] {
    own->family = "erob_100";
    own->only = "estimator";
  };
  out.own.option("--family", own->family, "of the gears' friction, from the robot's variation.yaml");
  out.own.option("--into", own->folder, "folder to write the identified robot to; default: none is kept");
  out.own.option("--only", own->only, "one of the experiments that score");
  out.run = [own](const ExperimentInput& in) { return run_bring_up(in, *own); };
  return out;
}

}  // namespace sprung
