#include "tools/station/gateway/served_robot_shell.h"

#include <sprung_version.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.h"
#include "runtime/types_hash.h"
#include "tools/station/gateway/message_bytes.h"

namespace sprung::gateway {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kProcesses_us = 500'000;
/// [design choice] of channels: what a page draws twenty times a second; the rest people read.
constexpr std::int64_t kDrawn_us = 50'000, kRead_us = 200'000;
constexpr std::uintmax_t kLargestRobotFile = 1'000'000;

bool is_moving(MotionPhase phase) noexcept {
  switch (phase) {
    case MotionPhase::kCrouch:
    case MotionPhase::kThrust:
    case MotionPhase::kFlight:
    case MotionPhase::kLanding:
    case MotionPhase::kRecover:
    case MotionPhase::kMovingJoint:
    case MotionPhase::kComplying:
    case MotionPhase::kWalking:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::vector<ServedRobot::Decimated> ServedRobot::decimated_channels() {
  std::vector<Decimated> out;
  for (const char* drawn : {channels::kDriveState, channels::kJointState, channels::kMotionState,
                            channels::kSafetyState, channels::kLegCommand, channels::kDriveCommand})
    out.push_back({{drawn, 0}, kDrawn_us});
  for (const char* read : {channels::kBusState, channels::kAuxiliaryState, channels::kImu})
    out.push_back({{read, 0}, kRead_us});
  return out;
}

ServedRobot::ServedRobot(const RunInfo& info) : info_(info), link_(info, station::robot_of(info)) {
  nlohmann::ordered_json run{{"run", nlohmann::ordered_json::parse(run_text(info))},
                             {"types", types_hash()},
                             {"version", SPRUNG_GIT_HASH}};
  run["files"] = nlohmann::ordered_json::array();
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(info.robot_folder, none))
    if (entry.is_regular_file() && entry.file_size() <= kLargestRobotFile)
      run["files"].push_back(entry.path().filename().string());
  description_ = run.dump();
}

bool ServedRobot::moves() {
  const auto& motion = link_.hear().motion.message;
  return motion && is_moving(static_cast<MotionPhase>(motion->state));
}

std::vector<std::string> ServedRobot::due(std::int64_t now_us) {
  std::vector<std::string> out;
  for (const station::RobotAnswer& answer : link_.take_answers()) out.push_back(reply_text(answer));
  for (Decimated& one : decimated_) {
    if (now_us < one.next_us) continue;
    const std::vector<std::uint8_t>* const bytes = link_.newest(one.reader);
    if (bytes == nullptr) continue;
    one.next_us = now_us + one.each_us;
    out.push_back(
        message_text(one.reader.channel, {reinterpret_cast<const char*>(bytes->data()), bytes->size()}));
  }
  if (now_us < next_processes_us_) return out;
  next_processes_us_ = now_us + kProcesses_us;
  for (const auto& [name, status] : link_.hear().processes)
    out.push_back(message_text(channels::kProcessStatus, encoded(status)));
  return out;
}

std::string ServedRobot::reply_text(const station::RobotAnswer& answer) const {
  sprung_msgs::operator_reply_t reply;
  reply.session = info_.session;
  reply.utime = link_.utime_us();
  reply.seq = 0;
  reply.request_id = answer.request_id;
  reply.took_effect_at_seq = answer.cycle;
  reply.outcome = static_cast<std::int8_t>(answer.outcome);
  reply.parameter = answer.parameter;
  reply.parameter_value = answer.parameter_value;
  reply.answered_by = answer.from;
  reply.reason = answer.reason;
  return message_text(channels::kOperatorReply, encoded(reply));
}

}  // namespace sprung::gateway
