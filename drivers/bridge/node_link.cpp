#include "drivers/bridge/node_link.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <utility>

namespace sprung {
namespace {

using canopen::NmtState;

constexpr std::int64_t kSdoTimeout_us =
    100'000;                                  // [design choice] an attempt; drives answer within milliseconds
constexpr std::int64_t kStampError_us = 200;  // [design choice] between the kernel's stamps and our clock
constexpr int kConflictsOfTwo = 3;            // [design choice] of ten cycles
constexpr int kDebtsExpire = 10;              // [design choice] cycles in a row that were answered in time
// [design choice] of silent_cycles: answers that come after their cycle show that a node lives, but nobody
// can control by them
constexpr int kUntimelyShare = 2;
constexpr int kContradictionsOfTwo = 2;        // [design choice] one may have been on its way
constexpr double kContradictionsFade = 20.0;   // [design choice] heartbeats
constexpr double kHeartbeatsOnTheirWay = 2.0;  // sent before NMT start, they lose arbitration to samples

const char* left_text(NmtState state) noexcept {
  return state == NmtState::kBootUp ? "it has restarted" : canopen::nmt_text(state);
}

bool is_communication_fault(int code) noexcept { return (code & 0xFF00) == 0x8100 || code == 0x8210; }

}  // namespace

NodeLink::NodeLink(const NodeSetup& setup, const IdentityConfig& identity, const NodeProfile& profile,
                   bool has_power)
    : setup_(setup),
      sdo_(setup.node, kSdoTimeout_us),
      boot_(setup_.name.c_str(), setup.node, make_boot_script(identity, profile, setup.node, has_power)) {
  transmitted_bytes_.fill(-1);
  for (const PdoSetting& pdo : profile.pdos()) {
    if (!pdo.transmit || pdo.entries.empty()) continue;
    int bits = 0;
    for (const canopen::MapEntry& entry : pdo.entries) bits += entry.bits;
    transmitted_bytes_[static_cast<std::size_t>(pdo.number)] = (bits + 7) / 8;
    if (pdo.transmission_type != canopen::kTypeEvent) sample_pdo_ = pdo.number;
  }
  health_.bus = setup.bus;
  health_.node = setup.node;
  health_.actuator = setup.actuator;
}

void NodeLink::step(std::int64_t time_us, FrameBatch& out) noexcept {
  watch_heartbeat(time_us);
  CanFrame frame;
  const bool send = boot_.operational() ? step_background(time_us, sdo_, frame) : step_boot(time_us, frame);
  if (send) out.push(setup_.bus, frame);
}

/// One that has to be asked, or reset once more, may have been without supply.
bool NodeLink::step_boot(std::int64_t time_us, CanFrame& out) noexcept {
  const BootState before = boot_.state();
  const bool send = boot_.step(time_us, sdo_, out);
  const BootState now = boot_.state();
  if (now != before && (now == BootState::kProbe || now == BootState::kReset)) on_possible_restart();
  return send;
}

bool NodeLink::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  if (frame.id == canopen::sdo_server_id(setup_.node)) {
    sdo_.receive(frame);
  } else if (frame.id == canopen::heartbeat_id(setup_.node)) {
    receive_heartbeat(frame, time_us);
  } else if (frame.id == canopen::emcy_id(setup_.node)) {
    receive_emergency(frame);
  } else {
    return receive_process_data(frame, time_us);
  }
  return true;
}

void NodeLink::receive_heartbeat(const CanFrame& frame, std::int64_t time_us) noexcept {
  const NmtState state = canopen::heartbeat_state(frame);
  const bool overtaken =
      boot_.operational() && state == NmtState::kPreOperational &&
      seconds(time_us - operational_us_) < kHeartbeatsOnTheirWay * setup_.watchdogs.heartbeat_s;
  if (state == NmtState::kUnknown) return;  // e.g. another tool's guard request: not the node's word
  heartbeat_us_ = std::max(heartbeat_us_, time_us);
  if (overtaken) return;
  follow_unasked_state(state);
  nmt_state_ = state;
  boot_.on_heartbeat(state, time_us);
}

void NodeLink::follow_unasked_state(NmtState state) noexcept {
  if (state == NmtState::kBootUp && boot_.configuring()) {
    ++health_.boot_ups;
    on_possible_restart();
  }
  if (!boot_.operational()) return;
  rebooted_ = rebooted_ || state == NmtState::kBootUp;
  // "Stopped" is one flipped bit away from "operational", the others are two and more: it needs a second
  // witness. Another device that is stopped and answers nothing disturbs nobody.
  const bool doubtful = state == NmtState::kStopped && !conflict_ && conflicts_.none();
  if (state == NmtState::kOperational || left_ || doubtful) return;
  left_ = true;
  answers_since_left_ = -1 - owed_;  // those to earlier SYNCs may still come
}

/// A node that has booted or left operational answers no SYNC: one that does is two.
void NodeLink::judge_contradiction() noexcept {
  if (!left_ || !answered_ || ++answers_since_left_ < 1) return;
  left_ = false;
  const double since_last_s = seconds(sync_us_ - contradiction_us_);
  if (since_last_s > kContradictionsFade * setup_.watchdogs.heartbeat_s) contradictions_ = 0;
  contradiction_us_ = sync_us_;
  contradictions_ += rebooted_ ? kContradictionsOfTwo : 1;
  if (contradictions_ >= kContradictionsOfTwo) duplicate_ = true;
}

void NodeLink::receive_emergency(const CanFrame& frame) noexcept {
  canopen::Emergency emergency;
  if (!canopen::decode_emergency(frame, emergency)) return;
  health_.error_register = emergency.error_register;
  // "No error" beside a register that is not 0: one of several is gone (facts canopen 1.5).
  emergency_withdrawn_ = emergency.code == 0 && emergency.error_register == 0;
  if (emergency.code == 0) return;
  emergency_ = emergency;
  communication_fault_ = communication_fault_ || is_communication_fault(emergency.code);
  emergency_seen_ = false;
  ++health_.emergencies;
  health_.last_emergency_code = emergency.code;
}

bool NodeLink::receive_process_data(const CanFrame& frame, std::int64_t time_us) noexcept {
  const auto pdo = static_cast<int>((frame.id - canopen::kTpdoBase) / 0x100U);
  const bool transmits = frame.id >= canopen::kTpdoBase && pdo < canopen::kPdoCount &&
                         frame.id == canopen::tpdo_id(pdo, setup_.node);
  if (!boot_.started()) return transmits;  // by the node's defaults until it is configured
  const int bytes = transmits ? transmitted_bytes_[static_cast<std::size_t>(pdo)] : -1;
  if (bytes < 0) return false;
  if (frame.length != bytes || frame.remote) {
    ++health_.short_frames;
  } else if (pdo == sample_pdo_) {
    receive_sample(frame, time_us);
  } else {
    take_other(frame);
  }
  return true;
}

void NodeLink::receive_sample(const CanFrame& frame, std::int64_t time_us) noexcept {
  confirm_operational(time_us);
  if (answered_ && !is_newer_answer(frame)) return;
  const bool late = !sampling_ || time_us < sync_us_ - kStampError_us;
  if (late || answered_) ++health_.late_samples;  // this one, or the one that it replaces
  if (!late) {
    answered_ = true;
    answer_ = frame;
  }
  ++answers_;
  const bool too_early = late && sampling_ && !answered_;  // for this SYNC's answer, which stays owed
  const bool owed = owed_ > (too_early ? 1 : 0);
  if (late && !owed) return;  // nobody knows what it answers
  owed_ -= owed ? 1 : 0;
  heard_late_ = late;
  take_sample(frame, time_us);
}

/// A frame that the bus repeats is harmless. One that differs is the next of those that the node owes: a
/// device that stalls pays late and in order, but never twice, so the last one is the sample. Beyond what is
/// owed there is another device; what that one can bring in before, after a loss, must follow from where the
/// drive was, as any sample.
bool NodeLink::is_newer_answer(const CanFrame& frame) noexcept {
  if (!(frame == answer_) && owed_ > 0) return true;
  ++health_.duplicate_samples;
  conflict_ = conflict_ || !(frame == answer_);
  return false;
}

void NodeLink::confirm_operational(std::int64_t time_us) noexcept {
  if (boot_.operational()) return;
  boot_.confirm_operational();
  if (!boot_.operational()) return;
  nmt_state_ = NmtState::kOperational;
  operational_us_ = heartbeat_us_ = time_us;
  age_cycles_ = untimely_cycles_ = 0;
  sdo_.finish();
  on_operational(time_us);
}

void NodeLink::begin_sampling(std::int64_t sync_us) noexcept {
  conflicts_ <<= 1;
  conflicts_[0] = conflict_;
  if (conflicts_.count() >= kConflictsOfTwo) duplicate_ = true;
  conflict_ = false;
  last_sync_us_ = std::exchange(sync_us_, sync_us);
  syncs_us_[static_cast<std::size_t>(syncs_++ % kMostOwed)] = sync_us;
  catching_up_ = owed_ > 0 && answers_ != 1;
  answers_ = 0;
  answered_ = false;
  sampling_ = true;
  if (boot_.operational() && owed_ < kMostOwed) ++owed_;
  if (emergency_withdrawn_ && emergency_seen_) forget_emergency();
}

std::int64_t NodeLink::earliest_sync_us() const noexcept {
  const int cycles = std::min({owed_, setup_.watchdogs.silent_cycles, kMostOwed - 1});
  const std::int64_t place = std::max<std::int64_t>(0, syncs_ - 1 - cycles);  // none is older than the first
  return syncs_us_[static_cast<std::size_t>(place % kMostOwed)];
}

void NodeLink::end_sampling() noexcept {
  sampling_ = false;
  const bool good = answered_ && accept_sample();
  const bool older = !answered_ && heard_late_ && accept_sample();
  punctual_cycles_ = answered_ ? punctual_cycles_ + 1 : 0;
  if (punctual_cycles_ >= kDebtsExpire) owed_ = 0;
  age_cycles_ = good ? 0 : age_cycles_ + 1;
  if (older) age_cycles_ = std::min(age_cycles_, owed_);
  untimely_cycles_ = good ? 0 : untimely_cycles_ + 1;
  heard_late_ = false;
  if (!good && boot_.operational()) ++health_.missing_samples;
  judge_contradiction();
}

void NodeLink::watch_heartbeat(std::int64_t time_us) noexcept {
  const bool is_lost = boot_.operational() && heartbeat_missing(time_us);
  if (is_lost && !heartbeat_lost_) ++health_.heartbeat_losses;
  heartbeat_lost_ = is_lost;
}

bool NodeLink::lost(std::int64_t time_us) const noexcept {
  return !boot_.operational() || nmt_state_ != NmtState::kOperational || rebooted_ ||
         heartbeat_missing(time_us);
}

bool NodeLink::silent() const noexcept {
  const int allowed = setup_.watchdogs.silent_cycles;
  return age_cycles_ > allowed || untimely_cycles_ > kUntimelyShare * allowed;
}

bool NodeLink::gone() const noexcept {
  return (nmt_state_ != NmtState::kOperational || rebooted_) && age_cycles_ > 0;
}

bool NodeLink::heartbeat_missing(std::int64_t time_us) const noexcept {
  return seconds(time_us - heartbeat_us_) > setup_.watchdogs.drive_heartbeat_s;
}

bool NodeLink::trouble(std::int64_t time_us, bool ignore_faults, Trouble& out) const noexcept {
  const char* who = setup_.name.c_str();
  out.cause = SafetyCause::kDriveSilent;
  if (duplicate_) {
    out.cause = SafetyCause::kDuplicateNode;
    print(out.detail, "%s: two devices answer as node %d; switch one off or give it another id", who,
          setup_.node);
  } else if (emergency_.code != 0 && !ignore_faults) {
    out.cause = SafetyCause::kDriveFault;
    print(out.detail, "%s: fault 0x%04X (%s)", who, emergency_.code,
          canopen::emergency_text(emergency_.code));
  } else if (gone()) {
    print(out.detail, "%s: no longer operational: %s", who,
          left_text(rebooted_ ? NmtState::kBootUp : nmt_state_));
  } else if (silent()) {
    const bool late = age_cycles_ <= setup_.watchdogs.silent_cycles;
    print(out.detail, "%s: did not answer SYNC%s for %d cycles", who, late ? " in time" : "",
          late ? untimely_cycles_ : age_cycles_);
  } else if (heartbeat_missing(time_us)) {
    print(out.detail, "%s: no heartbeat", who);
  } else {
    return false;
  }
  return true;
}

/// Without a power state machine only a reset of the communication helps: see needs_restart().
void NodeLink::reset_faults(bool reset) noexcept {
  if (reset) forget_emergency();
}

void NodeLink::forget_emergency() noexcept {
  emergency_ = {};
  communication_fault_ = false;
}

void NodeLink::restart() noexcept {
  boot_.restart();
  sdo_.finish();
  forget_emergency();
  conflicts_.reset();
  conflict_ = duplicate_ = rebooted_ = heartbeat_lost_ = false;
  left_ = false;
  contradictions_ = 0;
  age_cycles_ = untimely_cycles_ = owed_ = answers_ = punctual_cycles_ = 0;
  catching_up_ = heard_late_ = false;
  bus_loss_ = "";
}

bool NodeLink::needs_restart(std::int64_t time_us) const noexcept {
  return lost(time_us) || silent() || duplicate_ || communication_fault_ || *bus_loss_ != 0;
}

void NodeLink::set_recovery_text(const char* format, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(health_.recovery.data(), health_.recovery.size(), format, arguments);
  va_end(arguments);
  if (*note() == 0) return;
  const std::size_t used = std::strlen(health_.recovery.data());
  std::snprintf(health_.recovery.data() + used, health_.recovery.size() - used, "; %s", note());
}

NodeHealth NodeLink::health() const noexcept {
  NodeHealth health = health_;
  health.sdo_failures += boot_.sdo_failures();
  health.nmt_state = static_cast<std::int8_t>(nmt_state_);
  health.operational = boot_.operational() && nmt_state_ == NmtState::kOperational && !rebooted_;
  return health;
}

}  // namespace sprung
