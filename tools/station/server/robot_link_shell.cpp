#include "tools/station/server/robot_link_shell.h"

#include <type_traits>

#include "lcmtypes/channels.h"
#include "robots/maintenance.h"
#include "robots/robot_loader.h"
#include "tools/station/server/robot_channels.h"

namespace sprung::station {
namespace {

/// [design choice] Half a tick of the console: a wake-up for some 40 messages of pegasus; an answer waits as
/// long.
constexpr int kGather_ms = 10;
/// What is drawn 25 times a second need not be checked 500 times.
constexpr std::int64_t kDrawn_us = 8'000;
/// DRIVE_STATE confirms a stop, SAFETY_STATE has its cause: the last one that comes must be seen.
constexpr std::int64_t kEach_us = 0;

NodeOptions looking(const RunInfo& info) {
  NodeOptions options = commanding(info);
  options.gather_ms = kGather_ms;
  return options;
}

}  // namespace

RobotConfig robot_of(const RunInfo& info) {
  const RobotConfig robot = as_in_preset(load_robot(info.robot_folder), info.preset);
  return info.maintenance ? for_maintenance(robot) : robot;
}

void NewestBytes::put(const std::uint8_t* data, std::size_t size) {
  const std::lock_guard<std::mutex> lock(mutex_);
  bytes_.assign(data, data + size);
  ++version_;
}

bool NewestBytes::get(std::int64_t& version, std::vector<std::uint8_t>& out) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (version == version_) return false;
  version = version_;
  out = bytes_;
  return true;
}

template <class M>
void RobotLink::listen_to(const char* channel, std::int64_t rest_us, const CountLimits& limits) {
  NewestBytes& newest = newest_[channel];
  node_.on_bytes<M>(channel, limits, rest_us,
                    [&newest](const std::uint8_t* data, std::size_t size) { newest.put(data, size); });
  frame_readers_.push_back({channel, 0});
}

RobotLink::RobotLink(const RunInfo& info, const RobotConfig& robot)
    : frames_(robot),
      drive_reader_{channels::kDriveState, 0},
      joint_reader_{channels::kJointState, 0},
      motion_reader_{channels::kMotionState, 0},
      safety_reader_{channels::kSafetyState, 0},
      bus_reader_{channels::kBusState, 0},
      auxiliary_reader_{channels::kAuxiliaryState, 0},
      heard_joint_reader_{channels::kJointState, 0},
      node_(looking(info)),
      commands_(node_.publisher<OperatorCommand>(channels::kOperatorCommand)) {
  visit_robot_channels(robot, [this](const auto& channel) {
    using M = typename std::decay_t<decltype(channel)>::Message;
    const bool each = std::is_same_v<M, sprung_msgs::drive_state_t> ||
                      std::is_same_v<M, sprung_msgs::safety_state_t>;
    listen_to<M>(channel.name, each ? kEach_us : kDrawn_us, channel.limits);
  });
  node_.subscribe_message(channels::kProcessStatus, CountLimits::none(), processes_);
  node_.subscribe_message(channels::kOperatorReply, CountLimits::none(), replies_);
  node_.start();
}

const std::vector<std::pair<std::string, std::string>>& RobotLink::channels_heard() {
  static const std::vector<std::pair<std::string, std::string>> all = [] {
    std::vector<std::pair<std::string, std::string>> out;
    visit_robot_channels({}, [&out](const auto& channel) {
      out.emplace_back(channel.name, std::decay_t<decltype(channel)>::Message::getTypeName());
    });
    return out;
  }();
  return all;
}

bool RobotLink::newer(Reader& reader) { return newest_.at(reader.channel).get(reader.version, bytes_); }

template <class M>
bool RobotLink::newer(Reader& reader, M& out) {
  const int size = newer(reader) ? static_cast<int>(bytes_.size()) : 0;
  return size > 0 && out.decode(bytes_.data(), 0, size) == size;
}

void RobotLink::say(OperatorCommand command) {
  command.stamp.utime_us = node_.utime_us();
  commands_.publish(command);
}

std::vector<RobotAnswer> RobotLink::take_answers() {
  std::vector<RobotAnswer> out;
  while (const auto reply = replies_.pop())
    out.push_back({reply->request_id, static_cast<OperatorOutcome>(reply->outcome), reply->reason,
                   reply->answered_by, reply->took_effect_at_seq, reply->parameter, reply->parameter_value});
  return out;
}

bool RobotLink::drives(DriveState& out) {
  return newer(drive_reader_, drive_message_) && from_message(drive_message_, out).good;
}

bool RobotLink::joints(JointState& out) {
  return newer(joint_reader_, joint_message_) && from_message(joint_message_, out).good;
}

const HeardRobot& RobotLink::hear() {
  const std::int64_t now_us = node_.utime_us();
  while (auto status = processes_.pop()) heard_.processes[status->process] = *status;
  sprung_msgs::motion_state_t motion;
  if (newer(motion_reader_, motion)) heard_.motion.take(std::move(motion), now_us);
  sprung_msgs::safety_state_t safety;
  if (newer(safety_reader_, safety)) heard_.safety.take(std::move(safety), now_us);
  sprung_msgs::bus_state_t buses;
  if (newer(bus_reader_, buses)) heard_.buses.take(std::move(buses), now_us);
  sprung_msgs::auxiliary_state_t auxiliary;
  if (newer(auxiliary_reader_, auxiliary)) heard_.auxiliary.take(std::move(auxiliary), now_us);
  sprung_msgs::joint_state_t joints;
  if (newer(heard_joint_reader_, joints)) heard_.joints.take(std::move(joints), now_us);
  heard_.now_us = now_us;
  return heard_;
}

/// The channels' newest may be of neighbouring cycles; what is drawn 50 times a second does not show it.
const Frame* RobotLink::frame() {
  const double now_s = 1e-6 * static_cast<double>(node_.utime_us());
  for (Reader& reader : frame_readers_)
    if (newer(reader)) frames_.add(reader.channel, bytes_.data(), bytes_.size(), now_s);
  return frames_.finish();
}

}  // namespace sprung::station
