#include "tools/client/cycle_collector.h"

#include "lcmtypes/channels.h"

namespace sprung {

namespace {

constexpr std::size_t kQueue = 1 << 18;  // four minutes at 1 kHz
constexpr std::int64_t kGiveUp = 100;    // cycles after which a missing message will not come any more
constexpr unsigned kEveryPart = 0b111111;

}  // namespace

CycleCollector::CycleCollector(const RunInfo& info, const RobotConfig& robot)
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
      node_(NodeOptions{info.lcm_url, info.session, info.epoch_us, {}}) {
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

CycleCollector::Cycle& CycleCollector::cycle(std::int64_t seq) { return pending_[seq]; }

template <class Signal>
void CycleCollector::take(InputQueue<Signal>& queue, Signal Cycle::*member, unsigned part) {
  while (auto signal = queue.pop()) {
    if (signal->stamp.seq >= next_) {
      Cycle& target = cycle(signal->stamp.seq);
      target.*member = std::move(*signal);
      target.parts |= part;
    }
  }
}

void CycleCollector::take_all(const ReplyObserver& on_reply) {
  take(drive_states_, &Cycle::drive_state, 1u);
  take(joint_states_, &Cycle::joint_state, 2u);
  take(drive_commands_, &Cycle::drive_command, 4u);
  take(truths_, &Cycle::truth, 8u);
  take(leg_commands_, &Cycle::leg_command, 32u);
  while (auto message = motions_.pop()) {
    if (message->seq >= next_) {
      Cycle& target = cycle(message->seq);
      target.motion_state = MotionState(robot_.legs.size());
      if (from_message(*message, target.motion_state)) {
        target.motion_state.last_transition = "";  // pointed into the message
        target.parts |= 16u;
      }
    }
  }
  while (auto message = replies_.pop()) {
    OperatorReply reply;
    if (from_message(*message, reply)) {
      on_reply(reply);
    }
  }
  while (auto message = safeties_.pop()) {
    overruns_ = message->overruns;
    missed_cycles_ = message->missed_cycles;
  }
  while (auto message = statuses_.pop()) {
    if (message->process == "sprung-can-bridge") {
      repeats_ = message->sequence_gaps;
    }
  }
}

int CycleCollector::collect(const CycleObserver& on_cycle, const ReplyObserver& on_reply) {
  take_all(on_reply);
  int handed_over = 0;
  while (!pending_.empty()) {
    const auto first = pending_.begin();
    const bool hopeless = pending_.rbegin()->first - first->first > kGiveUp;
    const bool in_turn = next_ < 0 || first->first == next_;
    if ((first->second.parts != kEveryPart || !in_turn) && !hopeless) {
      break;
    }
    const bool joined_inside = next_ < 0 && first->second.parts != kEveryPart;
    if (next_ >= 0) {
      lost_ += first->first - next_;
    }
    next_ = joined_inside ? -1 : first->first + 1;
    if (first->second.parts == kEveryPart) {
      const Cycle& c = first->second;
      on_cycle({c.drive_state, c.joint_state, c.motion_state, c.drive_command, c.truth, c.leg_command});
      ++handed_over;
    } else if (!joined_inside) {
      ++lost_;
    }
    pending_.erase(first);
  }
  return handed_over;
}

}  // namespace sprung
