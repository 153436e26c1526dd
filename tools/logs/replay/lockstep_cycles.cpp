#include "tools/logs/replay/lockstep_cycles.h"

#include <algorithm>

#include "signals/own_inputs.h"
#include "tools/logs/log/used_inputs.h"

namespace sprung {

namespace {

enum Channel : std::size_t { kJoints, kLegs, kMotion, kDrives };

}  // namespace

bool LockstepFlaws::deterministic() const noexcept {
  return older.empty() && without_answer.empty() &&
         std::all_of(absent.begin(), absent.end(),
                     [](const AbsentCycles& one) { return one.never_made.empty(); });
}

bool LockstepFlaws::every_message() const noexcept {
  return std::all_of(absent.begin(), absent.end(), [](const AbsentCycles& one) {
    return one.never_made.empty() && one.not_in_log.empty();
  });
}

void LockstepCycles::add(const LoggedCycle& cycle) {
  if (cycle.anew) begin_anew();
  if (cycle.alone) flaws_.without_answer.add(cycle.seq);
  // First, since it says what became of the others.
  if (!cycle.drive_command.empty()) add_command(cycle.drive_command);
  const std::array<const Bytes*, LockstepFlaws::kChannels.size()> messages{
      &cycle.joint_state, &cycle.leg_command, &cycle.motion_state, &cycle.drive_command};
  for (std::size_t channel = 0; channel < messages.size(); ++channel) {
    if (!messages[channel]->empty()) add_message(channel, cycle.seq);
  }
}

void LockstepCycles::begin_anew() noexcept {
  newest_.fill(-1);
  for (log::CycleStretches* one :
       {&without_joint_state_, &without_leg_command_, &flaws_.older, &flaws_.without_answer})
    one->begin_anew();
  for (AbsentCycles& one : flaws_.absent) {
    one.never_made.begin_anew();
    one.not_in_log.begin_anew();
  }
}

void LockstepCycles::add_command(const Bytes& drive_command) {
  const auto used = log::used_inputs(drive_command.data(), drive_command.size());
  if (!used) return;
  if (!made_from_own_inputs(used->seq, used->joint_state_seq, used->leg_command_seq))
    flaws_.older.add(used->seq);
  if (used->joint_state_seq < used->seq) without_joint_state_.add(used->seq);
  if (used->leg_command_seq < used->seq - 1) without_leg_command_.add(used->seq);
}

/// Before a channel's first message its sender had not begun, and after the last it had ended.
void LockstepCycles::add_message(std::size_t channel, std::int64_t seq) {
  const std::int64_t first = newest_[channel] + 1, last = seq - 1;
  if (newest_[channel] >= 0 && first <= last) {
    AbsentCycles& absent = flaws_.absent[channel];
    (was_never_made(channel, first, last) ? absent.never_made : absent.not_in_log).add(first, last);
  }
  newest_[channel] = seq;
}

/// LEG_COMMAND(k) is for DRIVE_COMMAND(k + 1), JOINT_STATE(k) for that of its own cycle; the bridge tells
/// when it had no DRIVE_COMMAND(k).
bool LockstepCycles::was_never_made(std::size_t channel, std::int64_t first,
                                    std::int64_t last) const noexcept {
  if (channel == kDrives) return flaws_.without_answer.newest_has(first, last);
  if (channel == kJoints) return without_joint_state_.newest_has(first, last);
  return without_leg_command_.newest_has(first + 1, last + 1);
}

}  // namespace sprung
