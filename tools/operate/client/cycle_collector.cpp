#include "tools/operate/client/cycle_collector.h"

#include "lcmtypes/channels.h"
#include "signals/own_inputs.h"

namespace sprung {

namespace {

constexpr std::size_t kQueue = 1 << 18;  // four minutes at 1 kHz

}  // namespace

CycleCollector::CycleCollector(const RunInfo& info, const RobotConfig& robot)
    : CycleCollector(NodeOptions{info.lcm_url, info.session, info.epoch_us, {}}, robot) {}

CycleCollector::CycleCollector(const NodeOptions& options, const RobotConfig& robot)
    : robot_(robot),
      drive_states_(kQueue),
      joint_states_(kQueue),
      drive_commands_(kQueue),
      truths_(kQueue),
      leg_commands_(kQueue),
      motions_(kQueue),
      replies_(kQueue),
      safeties_(kQueue),
      statuses_(kQueue),
      node_(options) {
  const std::size_t actuators = robot.actuators.size();
  const std::size_t joints = robot.joints.size();
  const std::size_t legs = robot.legs.size();
  node_.subscribe(channels::kDriveState, CountLimits::exactly(actuators), drive_states_);
  node_.subscribe(channels::kJointState, CountLimits::exactly(joints, legs), joint_states_);
  node_.subscribe(channels::kDriveCommand, CountLimits::exactly(actuators), drive_commands_);
  node_.subscribe(channels::kSimTruth, CountLimits::exactly(joints, legs), truths_);
  node_.subscribe(channels::kLegCommand, CountLimits::exactly(legs), leg_commands_);
  node_.subscribe_message(channels::kMotionState, CountLimits::exactly(legs), motions_);
  node_.subscribe_message(channels::kOperatorReply, CountLimits::none(), replies_);
  node_.subscribe_message(channels::kSafetyState, CountLimits::none(), safeties_);
  node_.subscribe_message(channels::kProcessStatus, CountLimits::none(), statuses_);
  node_.start();
}

void CycleCollector::take_motions() {
  while (auto message = motions_.pop()) {
    MotionState motion(robot_.legs.size());
    if (!from_message(*message, motion)) continue;
    motion.last_transition = "";  // pointed into the message
    assembler_.add(std::move(motion));
  }
}

void CycleCollector::take_all(const ReplyObserver& on_reply) {
  take(drive_states_);
  take(joint_states_);
  take(drive_commands_);
  take(truths_);
  take(leg_commands_);
  take_motions();
  while (auto message = replies_.pop()) {
    OperatorReply reply;
    if (from_message(*message, reply)) on_reply(reply);
  }
  while (auto message = safeties_.pop()) {
    overruns_ = message->overruns;
    if (message->seq <= counted_until_) missed_cycles_ = message->missed_cycles;
  }
  while (auto message = statuses_.pop()) take_status(*message);
}

void CycleCollector::take_status(const sprung_msgs::process_status_t& status) {
  if (status.process == "sprung-can-bridge") repeats_ = status.sequence_gaps;
  const bool says_so = status.detail.find(kNotDeterministicNote) != std::string::npos;
  if (says_so && status.seq < counted_until_ && not_deterministic_.empty())
    not_deterministic_ = status.process + ": " + status.detail;
}

int CycleCollector::collect(const CycleObserver& on_cycle, const ReplyObserver& on_reply) {
  take_all(on_reply);
  return assembler_.hand_over(on_cycle);
}

}  // namespace sprung
