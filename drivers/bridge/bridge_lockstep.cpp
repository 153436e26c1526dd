#include <poll.h>
#include <time.h>

#include <cmath>

#include "drivers/bridge/bridge_shell.h"
#include "drivers/bridge/timeout.h"
#include "drivers/can/bus_addresses.h"
#include "drivers/can/lockstep_link.h"
#include "runtime/log.h"
#include "runtime/stop_request.h"
#include "signals/own_inputs.h"

namespace sprung {

namespace {

constexpr int kAbandoned_ticks = 20;

/// SYNC is the only tick; the wall clock only decides when to ask again and when to go on without an answer.
class LockstepBridge {
 public:
  LockstepBridge(Process& process, const BridgeProgramOptions& options)
      : process_(process),
        options_(options),
        cycle_us_(std::llround(process.robot().cycle_s * 1e6)),
        core_(with_bus_addresses(process.robot(), options.can), BridgeOptions{process.watchdogs()}),
        shell_(process, core_),
        state_(process.robot().actuators.size()),
        command_(process.robot().actuators.size()),
        last_tick_(options.cycles) {
    for (const std::string& address : bus_addresses(process.robot(), options.can)) {
      links_.emplace_back(open_udp_bus(address), parse_burst_faults(options.inject_can));
    }
  }

  int run() {
    const Receiving receiving(process_.node());
    process_.set_state(ProcessState::kReady);
    const std::int64_t started_us = wall_us();
    for (std::int64_t tick = 1; !core_.shut_down() && !abandoned(); ++tick) {
      run_tick(tick);
      follow_stop();
      process_.publish_status_if_due();
      if (options_.speed > 0.0) {
        const double due_us = static_cast<double>(tick * cycle_us_) / options_.speed;
        wait_for_pace(started_us + static_cast<std::int64_t>(due_us));
      }
    }
    shell_.report_end();
    return 0;
  }

 private:
  std::int64_t wall_us() const { return process_.node().utime_us(); }

  void run_tick(std::int64_t tick) {
    time_us_ = tick * cycle_us_;
    process_.statistics().begin_cycle(wall_us());
    shell_.serve_operators(time_us_);
    core_.begin_tick(time_us_, out_);
    shell_.trace(out_, true, time_us_);
    exchange(tick);
    if (core_.end_sampling(time_us_, state_)) {
      run_cycle();
    } else {
      shell_.publish_boot();
    }
    core_.emit_setpoints(time_us_, out_);
    process_.statistics().end_cycle(wall_us());
  }

  /// Sends the burst of this tick on every bus and takes the drives' answers.
  void exchange(std::int64_t tick) {
    for (std::size_t bus = 0; bus < links_.size(); ++bus) {
      links_[bus].add(out_, static_cast<int>(bus));
      links_[bus].send_burst(tick);
    }
    out_.clear();
    drives_.begin(wall_us());
    for (std::size_t bus = 0; bus < links_.size(); ++bus) {
      if (!await_answer(bus, tick)) {
        drives_.gave_up();
        ++silent_ticks_;
        core_.count_missed_cycle();
        tell_silent_drives(links_[bus].bus().describe());
      }
    }
  }

  /// Before the first cycle nothing has been made yet that could be made again.
  void tell_silent_drives(const std::string& bus) {
    const std::string what = "the drives do not answer on " + bus;
    if (process_.status().state == ProcessState::kReady) {
      process_.status().detail = what;
    } else {
      tell_not_deterministic(what);
    }
  }

  bool await_answer(std::size_t bus, std::int64_t tick) {
    LockstepLink& link = links_[bus];
    while (true) {
      for (LinkEvent event = link.poll(); event != LinkEvent::kNothing; event = link.poll()) {
        if (event == LinkEvent::kComplete && link.tick() == tick) {
          take_answer(static_cast<int>(bus), link.frames());
          drives_.answered();
          silent_ticks_ = 0;
          return true;
        }
      }
      if (drives_.over(wall_us())) {
        return false;
      }
      if (drives_.repeat_due(wall_us())) {
        link.resend();
        count_repeat();
      }
      pollfd fd{link.fd(), POLLIN, 0};
      poll(&fd, 1, milliseconds_until(drives_.wake_us()));
    }
  }

  void take_answer(int bus, const std::vector<CanFrame>& frames) {
    for (const CanFrame& frame : frames) {
      core_.receive(bus, frame, time_us_);
      shell_.trace(bus, frame, false, time_us_);
    }
  }

  void run_cycle() {
    shell_.follow_start();
    shell_.publish_cycle(state_);
    chain_.begin(wall_us());
    while (!take_command()) {
      if (chain_.over(wall_us())) {
        chain_.gave_up();
        core_.count_missed_cycle();
        shell_.publish_safety_if_due(time_us_);  // of this cycle, not the next
        tell_not_deterministic("no DRIVE_COMMAND for cycle " + std::to_string(state_.stamp.seq));
        return;
      }
      if (chain_.repeat_due(wall_us())) {
        shell_.repeat_drive_state();
        count_repeat();
      }
      process_.node().wait_for_input(chain_.wake_us());
      shell_.serve_operators(time_us_);
    }
    chain_.answered();
    core_.count_good_cycle();
    if (!made_from_own_inputs(command_.stamp.seq, command_.used_joint_state_seq,
                              command_.used_leg_command_seq))
      tell_not_deterministic("cycle " + std::to_string(command_.stamp.seq) + " was made from older messages");
  }

  /// Whoever runs it twice and compares shall know: `status` and the launcher show it from then on. An
  /// orderly end waits for nobody.
  void tell_not_deterministic(const std::string& what) {
    if (stopping_) return;
    const std::string note = what + ": " + kNotDeterministicNote;
    process_.set_standing_note(note);
    if (!told_not_deterministic_) log_warn(note);
    told_not_deterministic_ = true;
  }

  bool take_command() {
    if (shell_.take_command(command_)) {
      core_.command(command_, time_us_);
    }
    return shell_.has_command(state_.stamp.seq);
  }

  /// PROCESS_STATUS shows them as gaps: something was lost, or somebody was slow.
  void count_repeat() { ++process_.status().sequence_gaps; }

  /// Stopping, and the drives are gone too: there is nobody left to bring to rest.
  bool abandoned() const { return stopping_ && silent_ticks_ >= kAbandoned_ticks; }

  /// A stop brings the drives to rest first; the chain of processes still runs meanwhile.
  void follow_stop() {
    const bool at_end = last_tick_ > 0 && state_.stamp.seq + 1 >= last_tick_;
    if ((stop_requested() || at_end) && !stopping_) {
      stopping_ = true;
      drives_.gave_up();  // nobody may be left to answer: do not wait for the long first time
      chain_.gave_up();
      core_.begin_shutdown(time_us_);
    }
  }

  int milliseconds_until(std::int64_t wall_deadline_us) const {
    const std::int64_t left_us = wall_deadline_us - wall_us();
    return left_us <= 0 ? 0 : static_cast<int>(left_us / 1000 + 1);
  }

  /// Holds the pace of --speed; a stop request ends it early.
  void wait_for_pace(std::int64_t wall_deadline_us) const {
    const std::int64_t left_us = wall_deadline_us - wall_us();
    if (left_us > 0) {
      const timespec left{left_us / 1'000'000, left_us % 1'000'000 * 1000};
      pollfd stop{stop_fd(), POLLIN, 0};
      ppoll(&stop, stopping_ ? 0 : 1, &left, nullptr);
    }
  }

  Process& process_;
  const BridgeProgramOptions& options_;
  const std::int64_t cycle_us_;
  BridgeCore core_;
  BridgeShell shell_;
  std::vector<LockstepLink> links_;
  FrameBatch out_;
  DriveState state_;
  DriveCommand command_;
  Timeout drives_;
  Timeout chain_;
  const std::int64_t last_tick_;
  std::int64_t time_us_ = 0;
  int silent_ticks_ = 0;
  bool stopping_ = false;
  bool told_not_deterministic_ = false;
};

}  // namespace

int run_bridge_lockstep(Process& process, const BridgeProgramOptions& options) {
  return LockstepBridge(process, options).run();
}

}  // namespace sprung
