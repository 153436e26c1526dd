#pragma once
/// What every node of a bus needs, drive or encoder card: boot, SDO, NMT state and heartbeat watch,
/// emergencies, the answer to each SYNC, counters. Drives and cards derive from it and say what their process
/// data mean. Stepped by time.
#include <array>
#include <bitset>
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/bridge/node_boot.h"
#include "drivers/bridge/safety_machine.h"
#include "drivers/profiles/drive_profile.h"
#include "signals/bus_state.h"

namespace sprung {

struct NodeSetup {
  std::string name;
  int bus = 0;
  int node = 0;
  int actuator = -1;  ///< -1 = an encoder card
  WatchdogConfig watchdogs;
};

class NodeLink {
 public:
  NodeLink(const NodeSetup& setup, const IdentityConfig& identity, const NodeProfile& profile,
           bool has_power);
  virtual ~NodeLink() = default;
  NodeLink(const NodeLink&) = delete;
  NodeLink& operator=(const NodeLink&) = delete;

  /// Boot frames, then background reads; at most one frame.
  void step(std::int64_t time_us, FrameBatch& out) noexcept;
  /// @return false for a frame that this node has no business to send.
  bool receive(const CanFrame& frame, std::int64_t time_us) noexcept;
  void begin_sampling(std::int64_t sync_us) noexcept;
  /// Judges the answer to this SYNC, or counts that there is none.
  void end_sampling() noexcept;

  /// What is wrong with a node that should be running. @return false when nothing is; `out` is then
  /// untouched.
  virtual bool trouble(std::int64_t time_us, bool ignore_faults, Trouble& out) const noexcept;
  virtual bool faulted() const noexcept { return emergency_.code != 0; }
  virtual bool powered() const noexcept { return false; }
  /// Fault-reset edges until the fault is gone, where the node knows them.
  virtual void reset_faults(bool reset) noexcept;
  /// Begins the boot anew: reset communication and the whole script.
  virtual void restart() noexcept;
  /// Only a reset of its communication heals this (facts canopen 2.5).
  virtual bool needs_restart(std::int64_t time_us) const noexcept;

  void start() noexcept { boot_.start(); }
  /// Its bus was lost, so it may have let go or restarted unheard; until restart(). @param loss static text,
  /// e.g. "bus was off".
  void doubt(const char* loss) noexcept { bus_loss_ = loss; }
  const char* bus_loss() const noexcept { return bus_loss_; }  ///< "" = none
  /// Faults have been judged: one that the node has withdrawn may now be forgotten.
  void faults_seen() noexcept { emergency_seen_ = true; }

  const NodeBoot& boot() const noexcept { return boot_; }
  const std::string& name() const noexcept { return setup_.name; }
  const NodeSetup& setup() const noexcept { return setup_; }
  bool answered() const noexcept { return answered_; }
  /// Answered, and no more answers are on their way as far as one can tell: one that was silent may send
  /// older ones first.
  bool caught_up() const noexcept { return answered_ && !(catching_up_ && owed_ > 0); }
  int age_cycles() const noexcept { return age_cycles_; }
  /// Its newest answer is too old, or for twice that long none came in its cycle.
  bool silent() const noexcept;
  bool lost(std::int64_t time_us) const noexcept;  ///< not operational any more, or no heartbeat
  /// It says that it is not operational, and does not answer. One that says so and answers is two devices.
  bool gone() const noexcept;
  bool heartbeat_missing(std::int64_t time_us) const noexcept;
  bool rebooted() const noexcept { return rebooted_; }  ///< by itself, since the last restart()
  bool duplicate() const noexcept { return duplicate_; }
  /// Emergency that stands, or that a node in fault last sent.
  const canopen::Emergency& emergency() const noexcept { return emergency_; }
  /// Counters and states; the drive's reference is added by DriveNode.
  virtual NodeHealth health() const noexcept;
  /// What a clear did to this node.
  __attribute__((format(printf, 2, 3))) void set_recovery_text(const char* format, ...) noexcept;

 protected:
  /// Process data of the sample's own length.
  virtual void take_sample(const CanFrame& frame, std::int64_t time_us) noexcept = 0;
  /// Judges what take_sample() took last, at the end of a cycle. @return false when it is no new measurement.
  virtual bool accept_sample() noexcept = 0;
  virtual void take_other(const CanFrame&) noexcept {}
  virtual void on_operational(std::int64_t) noexcept {}
  /// Its supply may have been cut: it booted unasked, or a boot did not go straight through.
  virtual void on_possible_restart() noexcept {}
  /// Added to what a clear did to it; static text.
  virtual const char* note() const noexcept { return ""; }
  virtual bool step_background(std::int64_t, canopen::SdoClient&, CanFrame&) noexcept { return false; }

  /// Of the cycle that the sample counts for: the one before, when it came after that was over.
  std::int64_t sample_sync_us() const noexcept { return answered_ ? sync_us_ : last_sync_us_; }
  /// Of the oldest SYNC that this cycle's answer may belong to: answers come in order, and those that are
  /// owed may be lost, or still to come. None is older than the silence that a node is allowed.
  std::int64_t earliest_sync_us() const noexcept;
  void count_missing(int samples) noexcept { health_.missing_samples += samples; }
  void count_implausible() noexcept { ++health_.implausible_samples; }
  void count_sdo_failure() noexcept { ++health_.sdo_failures; }

 private:
  void receive_heartbeat(const CanFrame& frame, std::int64_t time_us) noexcept;
  bool step_boot(std::int64_t time_us, CanFrame& out) noexcept;
  void follow_unasked_state(canopen::NmtState state) noexcept;
  void receive_emergency(const CanFrame& frame) noexcept;
  void forget_emergency() noexcept;
  bool receive_process_data(const CanFrame& frame, std::int64_t time_us) noexcept;
  void receive_sample(const CanFrame& frame, std::int64_t time_us) noexcept;
  bool is_newer_answer(const CanFrame& frame) noexcept;
  void judge_contradiction() noexcept;
  void confirm_operational(std::int64_t time_us) noexcept;
  void watch_heartbeat(std::int64_t time_us) noexcept;

  NodeSetup setup_;
  canopen::SdoClient sdo_;
  NodeBoot boot_;
  std::array<int, canopen::kPdoCount> transmitted_bytes_{};  ///< of each TPDO; -1 = disabled
  int sample_pdo_ = -1;                                      ///< the TPDO that answers SYNC
  NodeHealth health_;

  static constexpr int kMostOwed = 64;  ///< [design choice] more would hide a second device for long

  std::int64_t sync_us_ = 0;
  std::int64_t last_sync_us_ = 0;
  std::array<std::int64_t, kMostOwed> syncs_us_{};  ///< of the last cycles, a ring
  std::int64_t syncs_ = 0;
  CanFrame answer_;           ///< the newest one to this SYNC
  bool sampling_ = false;     ///< between begin_sampling() and end_sampling()
  bool answered_ = false;     ///< this SYNC
  int owed_ = 0;              ///< answers to SYNCs that have not come, as far as they may still come
  int answers_ = 0;           ///< since this SYNC, to whichever
  bool catching_up_ = false;  ///< it owes answers, and did not send just one in the last cycle
  int punctual_cycles_ = 0;   ///< in a row that were answered
  int age_cycles_ = 0;        ///< of the newest answer
  int untimely_cycles_ = 0;   ///< in a row without an answer in time
  bool heard_late_ = false;   ///< an answer has come since the last cycle was over, to an older SYNC

  bool conflict_ = false;      ///< two different answers to this SYNC
  std::bitset<10> conflicts_;  ///< of the last cycles
  bool rebooted_ = false;      ///< boot-up that nobody asked for, since the last restart()
  bool left_ = false;          ///< its heartbeat says so; not yet known whether its answers agree
  int answers_since_left_ = 0;
  int contradictions_ = 0;  ///< it said that it had left operational, and went on answering
  std::int64_t contradiction_us_ = 0;
  bool duplicate_ = false;
  const char* bus_loss_ = "";

  canopen::Emergency emergency_;
  bool communication_fault_ = false;  ///< told since there was no fault, whatever emergency came after
  bool emergency_seen_ = false;       ///< by faults_seen()
  bool emergency_withdrawn_ = false;  ///< forgotten by the next begin_sampling() after it was seen
  canopen::NmtState nmt_state_ = canopen::NmtState::kUnknown;
  std::int64_t operational_us_ = 0;
  std::int64_t heartbeat_us_ = 0;
  bool heartbeat_lost_ = false;
};

}  // namespace sprung
