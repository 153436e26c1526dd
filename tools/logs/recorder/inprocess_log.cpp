#include "tools/logs/recorder/inprocess_log.h"

#include <atomic>
#include <cstdio>
#include <filesystem>

#include "lcmtypes/channels.h"
#include "runtime/log.h"
#include "signals/messages.h"
#include "simulation/plant/plant_words.h"
#include "tools/logs/recorder/log_metadata.h"

namespace sprung {

namespace {

constexpr std::int64_t kSession = 1;

sprung_msgs::log_metadata_t metadata_of(const RobotConfig& robot, const std::string& preset,
                                        const std::string& command_line) {
  RecordedRun run;
  run.preset = preset;
  run.clock = "inprocess";
  run.simulation = true;
  run.session = kSession;
  run.command_line = command_line;
  return make_log_metadata(robot, run);
}

}  // namespace

InProcessLog::InProcessLog(const std::string& path, const RobotConfig& robot, const std::string& preset,
                           const std::string& command_line)
    : recording_({path, 0, 0, 0, false}, metadata_of(robot, preset, command_line)) {}

InProcessLog::~InProcessLog() {
  recording_.end(time_us_, LogEndReason::kAsked, "the robot's run has ended");
  if (recording_.ended() != LogEndReason::kAsked) log_error("the log is not whole: " + recording_.detail());
}

template <class Signal>
void InProcessLog::write(const char* channel, const Signal& signal) {
  MessageOf<Signal> message;
  to_message(signal, kSession, message);
  bytes_.resize(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
  recording_.add(time_us_, channel, bytes_.data(), bytes_.size());
}

void InProcessLog::on_command(const OperatorCommand& command) { write(channels::kOperatorCommand, command); }

void InProcessLog::on_reply(const OperatorReply& reply) { write(channels::kOperatorReply, reply); }

void InProcessLog::on_cycle(const InProcessRobot& robot) {
  time_us_ = robot.drive_state().stamp.utime_us;
  write(channels::kDriveState, robot.drive_state());
  if (robot.imu().stamp.seq >= 0) write(channels::kImu, robot.imu());
  write(channels::kJointState, robot.joint_state());
  BodyState body;
  if (robot.cycle() % kBodyState_cycles == 0 && robot.body_state(body)) write(channels::kBodyState, body);
  write(channels::kDriveCommand, robot.drive_command());
  write(channels::kLegCommand, robot.leg_command());
  if (robot.planned()) write(channels::kMotionState, robot.motion_state());
  write(channels::kSimTruth, robot.truth());
}

InProcessRobot::ObserverSource logs_into(const std::string& folder, const std::string& command_line) {
  std::filesystem::create_directories(folder);
  const auto count = std::make_shared<std::atomic<int>>(0);
  return [=](const RobotConfig& robot, const std::string& preset, const SimOptions& sim) {
    char number[16];
    std::snprintf(number, sizeof number, "-%03d.lcm", (*count)++);
    return std::make_unique<InProcessLog>((std::filesystem::path(folder) / (robot.name + number)).string(),
                                          robot, preset, command_line + plant_text(sim.plant));
  };
}

}  // namespace sprung
