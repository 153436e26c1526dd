#include "tools/logs/replay/log_cycles.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "lcmtypes/channels.h"
#include "runtime/message_layout.h"
#include "runtime/receive_guard.h"
#include "signals/modes.h"
#include "tools/logs/fields/type_table.h"
#include "tools/logs/recorder/gap_tracker.h"

namespace sprung {

namespace {

constexpr std::string_view kProgramOfCore[kCores] = {"sprung-torque-estimator", "sprung-motion-planner",
                                                     "sprung-leg-controller"};
constexpr std::string_view kPlanner = kProgramOfCore[static_cast<std::size_t>(Core::kPlanner)];

template <class M>
bool decode(const std::uint8_t* data, std::size_t size, M& out) {
  ReceiveGuard guard("", layout_of<M>(), CountLimits::none(), 0);
  return guard.decode(data, size, out) == Refusal::kNone;
}
template <class M>
bool decode(const log::Event& event, M& out) {
  return decode(event.data, event.size, out);
}

/// Emergency stop, clear and homing are the bridge's.
bool is_motion(std::int8_t kind) {
  const auto value = static_cast<OperatorKind>(kind);
  return value != OperatorKind::kEstop && value != OperatorKind::kClear && value != OperatorKind::kHome;
}

Bytes bytes_of(const log::Event& event) { return {event.data, event.data + event.size}; }

/// As a planner of today would have written it: one of before has a field of another name, and the same
/// bytes.
Bytes reply_bytes(const log::Event& event) {
  static const std::int64_t former = fields::TypeTable::former().front().by_name("operator_reply_t")->hash;
  Bytes bytes = bytes_of(event);
  constexpr std::size_t kHashBytes = 8;
  if (bytes.size() < kHashBytes || read_int64(bytes.data(), 0) != former) return bytes;
  const auto hash = static_cast<std::uint64_t>(sprung_msgs::operator_reply_t::getHash());
  for (std::size_t i = 0; i < kHashBytes; ++i) bytes[i] = static_cast<std::uint8_t>(hash >> (56 - 8 * i));
  return bytes;
}

/// nullptr where a channel has not one message each cycle, or none that a core takes or makes.
Bytes LoggedCycle::*member_of(std::string_view channel) noexcept {
  using namespace channels;
  constexpr std::pair<std::string_view, Bytes LoggedCycle::*> kCyclic[] = {
      {kDriveState, &LoggedCycle::drive_state},   {kImu, &LoggedCycle::imu},
      {kJointState, &LoggedCycle::joint_state},   {kLegCommand, &LoggedCycle::leg_command},
      {kMotionState, &LoggedCycle::motion_state}, {kDriveCommand, &LoggedCycle::drive_command}};
  for (const auto& [name, member] : kCyclic) {
    if (channel == name) return member;
  }
  return nullptr;
}

/// What comes first of a cycle, from the bridge and the simulated drives. Whoever answers may stall and then
/// tell of cycles long gone: that is no new beginning.
bool begins_cycles(Bytes LoggedCycle::*member) noexcept {
  return member == &LoggedCycle::drive_state || member == &LoggedCycle::imu;
}

}  // namespace

bool LoggedCycle::empty() const noexcept {
  return drive_state.empty() && imu.empty() && joint_state.empty() && leg_command.empty() &&
         motion_state.empty() && drive_command.empty();
}

bool LoggedCycle::answered() const noexcept {
  return !(joint_state.empty() && leg_command.empty() && motion_state.empty() && drive_command.empty());
}

void LoggedCycle::clear() noexcept {
  seq = -1;
  time_us = 0;
  time_s = 0.0;
  alone = anew = false;
  restarted = {};
  for (Bytes* bytes : {&drive_state, &imu, &joint_state, &leg_command, &motion_state, &drive_command})
    bytes->clear();
  operator_commands.clear();
  replies.clear();
}

LogCycles::LogCycles(Use use) : use_(std::move(use)), window_(kWindow) {}

void LogCycles::add(const log::Event& event, double time_s) {
  if (Bytes LoggedCycle::*const member = member_of(event.channel)) return add_cyclic(member, event, time_s);
  if (event.channel == channels::kOperatorCommand) return add_command(event);
  if (event.channel == channels::kOperatorReply) return add_reply(event);
  if (event.channel == channels::kProcessStatus) return add_status(event);
  if (event.channel == channels::kSafetyState) return add_safety(event);
}

bool LogCycles::uses(std::string_view channel) noexcept {
  using namespace channels;
  return member_of(channel) != nullptr || channel == kOperatorCommand || channel == kOperatorReply ||
         channel == kProcessStatus || channel == kSafetyState;
}

void LogCycles::take_session(std::int64_t session) {
  if (session == session_) return;
  if (session_ != 0) {
    restart();
    went_on_.begin_anew();
  }
  session_ = session;
}

void LogCycles::add_cyclic(Bytes LoggedCycle::*member, const log::Event& event, double time_s) {
  if (event.size < kCountsOffset) {
    ++flaws_.foreign;
    return;
  }
  const std::int64_t seq = read_int64(event.data, kSeqOffset);
  if (seq < 0) return;
  if (seq > kLastCycle) {
    ++flaws_.foreign;
    return;
  }
  take_session(read_int64(event.data, kSessionOffset));
  if (begins_cycles(member) && begun_ && seq < newest_ - kWindow) restart();
  LoggedCycle* const cycle = cycle_of(seq);
  if (cycle == nullptr) return;
  if (cycle->time_us == 0) {
    cycle->time_us = event.time_us;
    cycle->time_s = time_s;
  }
  Bytes& bytes = cycle->*member;
  if (!bytes.empty()) return;  // lock-step repeats what was lost: the first one counts
  bytes.assign(event.data, event.data + event.size);
  const auto take_restart = [&](Core core) {
    const auto index = static_cast<std::size_t>(core);
    cycle->restarted[index] = cycle->restarted[index] || std::exchange(restarted_[index], false);
  };
  if (member == &LoggedCycle::joint_state) take_restart(Core::kEstimator);
  if (member == &LoggedCycle::drive_command) take_restart(Core::kController);
  if (member == &LoggedCycle::leg_command) {
    take_restart(Core::kPlanner);
    newest_leg_command_ = std::max(newest_leg_command_, cycle->seq);
  }
}

/// nullptr where the cycle is none, or was handed out.
LoggedCycle* LogCycles::cycle_of(std::int64_t seq) {
  if (seq < 0) return nullptr;
  if (!begun_) {
    begun_ = true;
    newest_ = handed_out_ = std::max<std::int64_t>(-1, seq - kWindow / 2);
  }
  if (seq <= handed_out_) {
    ++flaws_.late;
    return nullptr;
  }
  advance_to(seq);
  LoggedCycle& cycle = slot(seq);
  cycle.seq = seq;
  return &cycle;
}

void LogCycles::advance_to(std::int64_t seq) {
  if (seq <= newest_) return;
  newest_ = seq;
  const std::int64_t last_out = seq - kWindow;
  // A gap that is longer than the window is not walked through.
  const std::int64_t last_held = handed_out_ + kWindow;
  for (std::int64_t k = handed_out_ + 1; k <= std::min(last_out, last_held); ++k) hand_out(k);
  handed_out_ = std::max(handed_out_, last_out);
}

void LogCycles::hand_out(std::int64_t seq) {
  LoggedCycle& cycle = slot(seq);
  if (cycle.seq == seq) {
    give_commands(cycle);
    cycle.anew = std::exchange(anew_, false);
    use_(cycle);
    cycle.clear();
  }
  handed_out_ = seq;
}

void LogCycles::finish() {
  if (!begun_) return;
  for (std::int64_t k = handed_out_ + 1; k <= newest_; ++k) hand_out(k);
}

void LogCycles::restart() {
  finish();
  restarted_ = {};
  begun_ = false;
  anew_ = true;
  newest_leg_command_ = -1;
  for (auto executed = executed_.begin();
       executed != executed_.end();)  // the bridge began anew in its session
    executed = executed->first.first == session_ ? executed_.erase(executed) : std::next(executed);
  for (WaitingCommand& command : waiting_) command.from_seq = 0;
}

void LogCycles::add_status(const log::Event& event) {
  sprung_msgs::process_status_t status;
  if (!decode(event, status)) return;
  std::int64_t& pid = pids_[{status.session, status.process}];
  if (status.session == session_) {
    std::string what = went_on_.add_status(event.data, event.size);
    if (!what.empty()) flaws_.said.push_back(std::move(what));
  }
  const bool restarted = pid != 0 && pid != status.pid && status.session == session_;
  pid = status.pid;
  if (!restarted) return;
  const auto* const core = std::find(std::begin(kProgramOfCore), std::end(kProgramOfCore), status.process);
  if (core != std::end(kProgramOfCore))
    restarted_[static_cast<std::size_t>(core - std::begin(kProgramOfCore))] = true;
}

/// Only of cycles that are here anyway: it begins none and makes none late.
void LogCycles::add_safety(const log::Event& event) {
  if (event.size < kCountsOffset) return;
  const bool of_cycles = session_ == 0 || read_int64(event.data, kSessionOffset) == session_;
  if (!of_cycles || went_on_.add_safety(event.data, event.size) == 0) return;
  const std::int64_t seq = read_int64(event.data, kSeqOffset);
  if (seq <= handed_out_ || seq > newest_) return;
  LoggedCycle& cycle = slot(seq);
  if (cycle.seq == seq) cycle.alone = true;
}

void LogCycles::add_command(const log::Event& event) {
  sprung_msgs::operator_command_t command;
  if (!decode(event, command) || !is_motion(command.kind)) return;
  const Request request{command.session, command.request_id};
  const auto same = [&](const WaitingCommand& waiting) { return waiting.request == request; };
  const bool repeated = std::any_of(waiting_.begin(), waiting_.end(), same);
  if (repeated || executed_.count(request) > 0) return;
  const bool of_cycles = command.session == session_;
  waiting_.push_back(
      {request, command.apply_at_seq, of_cycles ? newest_leg_command_ + 1 : 0, bytes_of(event)});
}

/// A reply that is not the planner core's own ("queued", "too many wait") comes from its shell, under a short
/// name.
void LogCycles::add_reply(const log::Event& event) {
  const Bytes bytes = reply_bytes(event);
  sprung_msgs::operator_reply_t reply;
  if (!decode(bytes.data(), bytes.size(), reply) || reply.answered_by != kPlanner) return;
  executed_.emplace(Request{reply.session, reply.request_id}, reply.seq);
  if (reply.session != session_ || reply.seq <= handed_out_ || reply.seq > kLastCycle) return;
  LoggedCycle* const cycle = cycle_of(reply.seq);
  if (cycle == nullptr) return;
  const bool repeated = std::find(cycle->replies.begin(), cycle->replies.end(), bytes) !=
                        cycle->replies.end();
  if (!repeated) cycle->replies.push_back(bytes);
}

/// Commands whose cycle a reply names come in that cycle; the others where they stand in the log: the planner
/// itself makes them wait for their cycle.
void LogCycles::give_commands(LoggedCycle& cycle) {
  if (cycle.leg_command.empty() && cycle.motion_state.empty()) return;
  const auto due = [&](const WaitingCommand& command) {
    if (command.request.first != session_) return false;
    const auto executed = executed_.find(command.request);
    return (executed == executed_.end() ? command.from_seq : executed->second) <= cycle.seq;
  };
  const auto later = std::stable_partition(waiting_.begin(), waiting_.end(), due);
  for (auto command = waiting_.begin(); command != later; ++command) {
    const bool waits = command->apply_at_seq > cycle.seq;
    if (!waits && executed_.count(command->request) == 0) ++flaws_.unanswered;
    executed_.emplace(command->request, cycle.seq);
    cycle.operator_commands.push_back(std::move(command->bytes));
  }
  waiting_.erase(waiting_.begin(), later);
}

}  // namespace sprung
