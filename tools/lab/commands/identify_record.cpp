#include "tools/lab/commands/identify_record.h"

#include <cstdio>
#include <ctime>
#include <filesystem>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "simulation/plant/plant_words.h"
#include "tools/lab/identify/identify_recording.h"
#include "tools/lab/identify/record_in_process.h"
#include "tools/lab/identify/record_log.h"
#include "tools/lab/identify/record_session.h"
#include "tools/operate/client/angle_text.h"
#include "tools/operate/commands/answers.h"
#include "tools/operate/launcher/child_process.h"

namespace sprung::commands {

namespace {

constexpr double kLoggerStart_s = 0.5;
constexpr double kLoggerEnd_s = 3.0;
constexpr double kSwingOut_s = 2.0;
constexpr int kSendings = 3;  // nothing acknowledges it; sim-drives tells a repeat by its stamp
/// What identification reads, and what says afterwards what happened. Not the simulation's truth.
constexpr const char* kChannels =
    "--channel=(DRIVE_STATE|DRIVE_COMMAND|JOINT_STATE|MOTION_STATE|SAFETY_STATE|OPERATOR_COMMAND|OPERATOR_"
    "REPLY|"
    "PROCESS_STATUS)";

identify::AskedRange asked_range(const GuidedRecording& request) {
  identify::AskedRange asked;
  try {
    const std::size_t colon = request.range.find(':');
    if (!request.range.empty()) {
      if (colon == std::string::npos) throw std::invalid_argument("expected LOW:HIGH, as in 0.5rad:2rad");
      asked.low_rad = parse_angle_rad(request.range.substr(0, colon));
      asked.high_rad = parse_angle_rad(request.range.substr(colon + 1));
    }
    if (!request.fastest.empty()) asked.speed_rad_s = parse_angle_rad(request.fastest, "/s");
  } catch (const std::invalid_argument& error) {
    throw WrongUse(std::string("--range or --fastest: ") + error.what());
  }
  return asked;
}

identify::RecordOptions options_of(const GuidedRecording& request) {
  if (!(request.longest_pass_s > 0.0)) throw WrongUse("--longest-pass is more than 0 s");
  if (!(request.pause_s >= 0.0)) throw WrongUse("--pause is not negative");
  const double weight_kg = request.weight.empty() ? 0.0 : identify::parse_weight_kg(request.weight);
  return {request.longest_pass_s, request.pause_s, weight_kg, request.loaded, asked_range(request)};
}

/// A joint or a range that the robot does not have, as what the user typed wrong.
template <class Act>
auto understood(const Act& act) {
  try {
    return act();
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
}

int joint_of(const RobotConfig& robot, const GuidedRecording& request) {
  return understood([&] { return joint_named(robot, request.joint); });
}

/// The plant's base to a height at which legs hang free.
void hang_up(const RunInfo& info, const RobotConfig& robot) {
  Node node(commanding(info));
  Publisher<SimControl> controls = node.publisher<SimControl>(channels::kSimControl);
  SimControl control;
  control.kind = SimControlKind::kSuspend;
  control.value = identify::hanging_height_m(robot);
  control.stamp = {node.utime_us(), 0};
  for (int i = 0; i < kSendings; ++i) controls.publish(control);
}

std::string file_of(const GuidedRecording& request) {
  if (!request.file.empty()) return request.file;
  return request.robot + "-" + request.joint + "-" + std::to_string(std::time(nullptr)) + ".lcm";
}

int next_step(const GuidedRecording& request, const std::string& file) {
  const std::string weight = request.weight.empty() ? "" : " --weight " + request.weight;
  std::printf("recorded %s, %lld bytes. Next:\n  sprung identify --log %s%s --robot %s --joint %s\n",
              file.c_str(), static_cast<long long>(std::filesystem::file_size(file)), file.c_str(),
              weight.c_str(), request.robot.c_str(), request.joint.c_str());
  return kExitDone;
}

int report(const GuidedRecording& request, const identify::SessionResult& result, const std::string& file) {
  if (result.complete) return next_step(request, file);
  std::fprintf(stderr, "not complete: %s\n%s holds what there is\n", result.reason.c_str(), file.c_str());
  return kExitFailed;
}

int run_in_process(const GuidedRecording& request) {
  start_log("sprung");
  const RobotConfig robot = load_robot(request.robot);
  SimOptions sim;
  sim.seed = request.seed;
  sim.plant = parse_plant(request.plant);
  const identify::RecordOptions options = options_of(request);
  const int joint = joint_of(robot, request);
  const identify::JointRecording recording = understood(
      [&] { return identify::record_in_process(robot, sim, joint, options); });
  const std::string file = file_of(request);
  identify::write_drive_log(file, recording.states);
  return next_step(request, file);
}

}  // namespace

void add_guided_recording(CommandLine& identify, GuidedRecording& request) {
  identify.flag(
      "--record", request.wanted,
      "guided: moves JOINT of the running ROBOT through a protocol inside its limits, and records it");
  identify.option("ROBOT", request.robot, "with --record: which robot is up");
  identify.option("JOINT", request.joint, "with --record: which joint");
  identify.flag("--suspended", request.suspended,
                "with --record: the robot hangs free (simulated: it is hung up)");
  identify.option("--out", request.file, "with --record: LCM log to write, default ROBOT-JOINT-TIME.lcm");
  identify.option("--range", request.range, "with --record: LOW:HIGH, narrower than the limits: 0.5rad:2rad");
  identify.option("--fastest", request.fastest, "with --record: slower than half the limit: 1rad/s");
  identify.option("--longest-pass", request.longest_pass_s,
                  "with --record: s of one pass at constant speed; shorter shows less of slow friction");
  identify.flag(
      "--loaded", request.loaded,
      "with --record: the leg's other joints go where a weight at its foot loads JOINT, before it moves");
  identify.option("--pause", request.pause_s, "with --record: s at each stop");
  identify.flag("--in-process", request.in_process,
                "with --record: no robot is up; a simulated one moves in this process, fast, the same bytes "
                "every time");
  identify.option("--seed", request.seed, "with --in-process: of every noise");
  identify.option("--plant", request.plant,
                  "with --in-process: KEY=VALUE changes the plant; may be repeated");
  identify.flag("--yes", request.yes, "with --record: do not ask");
  identify.option("--instance", request.instance, "with --record: which run");
}

int run_guided_recording(const GuidedRecording& request) {
  if (request.robot.empty() || request.joint.empty()) throw WrongUse("--record needs ROBOT and JOINT");
  if (request.in_process) return run_in_process(request);
  const identify::RecordOptions options = options_of(request);
  const RunInfo info = require_running(request.instance, request.robot);
  const RobotConfig robot = load_robot(info.robot_folder);
  const int joint = joint_of(robot, request);
  if (robot.has_feet() && !request.suspended)
    throw WrongUse(robot.name +
                   " has feet, and must hang free: add --suspended (simulated: it is hung up; real: "
                   "you have hung it up)");
  JointMover mover(info, robot);
  const identify::RecordPlan plan = understood(
      [&] { return identify::plan_recording(robot, joint, options, mover); });
  const std::string weight = request.weight.empty() ? "" : " " + request.weight + " are clamped to its foot.";
  if (!confirmed(identify::describe(robot, plan) + weight + " Is everybody clear of it?", request.yes))
    return kExitFailed;
  const std::string file = file_of(request);
  ChildProcess logger(system_program("lcm-logger", "liblcm-bin"),
                      {"--lcm-url=" + info.lcm_url, "-q", "-f", kChannels, file});
  if (robot.has_feet() && info.simulation) hang_up(info, robot);
  mover.pause(robot.has_feet() && info.simulation ? kSwingOut_s : kLoggerStart_s);
  const identify::SessionResult result = identify::carry_out(plan, mover, [](const std::string& line) {
    std::printf("%s\n", line.c_str());
    std::fflush(stdout);
  });
  const bool died = logger.ended().has_value();
  logger.stop(kLoggerEnd_s);
  if (died) {
    std::fprintf(stderr, "lcm-logger ended by itself: check that %s can be written\n", file.c_str());
    return kExitFailed;
  }
  return report(request, result, file);
}

}  // namespace sprung::commands
