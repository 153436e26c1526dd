#include <poll.h>

#include <cmath>

#include "drivers/can/bus_addresses.h"
#include "drivers/can/lockstep_link.h"
#include "runtime/log.h"
#include "runtime/stop_request.h"
#include "signals/own_inputs.h"
#include "simulation/sim_shell.h"

namespace sprung {

namespace {

constexpr std::int64_t kMasterGone_us = 1'000'000;
constexpr std::int64_t kFreeStep_us = 1'000;
constexpr int kSilence_ms = 50;  // as the bridge waits before it repeats

class LockstepSim {
 public:
  LockstepSim(Process& process, const SimProgramOptions& options)
      : process_(process),
        cycle_us_(std::llround(process.robot().cycle_s * 1e6)),
        core_(process.robot(), options.sim),
        shell_(process, core_, options.sim.truth) {
    for (const std::string& address : bus_addresses(process.robot(), options.can)) {
      links_.emplace_back(open_udp_bus(address), parse_burst_faults(options.inject_can));
      fds_.push_back({links_.back().fd(), POLLIN, 0});
    }
  }

  int run() {
    const Receiving receiving(process_.node());
    process_.set_state(ProcessState::kReady);
    heard_us_ = wall_us();
    while (!stop_requested()) {
      const int woken = poll(fds_.data(), fds_.size(), running_free_ ? 1 : kSilence_ms);
      if (woken == 0 && !running_free_) shell_.repeat();  // somebody may wait for what was lost
      for (LockstepLink& link : links_) {
        listen(link);
      }
      if (every_bus_has(tick_ + 1)) {
        step();
      }
      run_free_if_alone();
      process_.publish_status_if_due();
    }
    return 0;
  }

 private:
  std::int64_t wall_us() const { return process_.node().utime_us(); }

  /// A burst that was answered before is answered again from store; nothing is stepped.
  void listen(LockstepLink& link) {
    while (link.tick() <= tick_) {  // what completes a new tick waits for the other buses
      const LinkEvent event = link.poll();
      if (event == LinkEvent::kNothing) {
        return;
      }
      heard_us_ = wall_us();
      if (event == LinkEvent::kRepeat) {
        link.resend();
        shell_.repeat();
      } else if (tick_ == 0) {
        tick_ = link.tick() - 1;  // joined late: the first burst is the first tick
      }
    }
  }

  bool every_bus_has(std::int64_t tick) const {
    for (const LockstepLink& link : links_) {
      if (link.tick() < tick) {
        return false;
      }
    }
    return true;
  }

  void step() {
    process_.statistics().begin_cycle(wall_us());
    shell_.take_controls();
    const std::int64_t last_us = tick_ * cycle_us_;
    tick_ = links_.front().tick();
    const std::int64_t sync_us = tick_ * cycle_us_;
    burst_.clear();
    for (std::size_t bus = 0; bus < links_.size(); ++bus) {
      for (const CanFrame& frame : links_[bus].frames()) {
        burst_.push(static_cast<int>(bus), frame);
      }
    }
    core_.receive_burst(burst_, last_us, sync_us);
    advance(sync_us);
    shell_.publish_imu(sync_us);
    for (std::size_t bus = 0; bus < links_.size(); ++bus) {
      links_[bus].add(answers_, static_cast<int>(bus));
      links_[bus].send_answer(tick_);
    }
    shell_.publish();
    process_.statistics().end_cycle(wall_us());
  }

  void advance(std::int64_t time_us) {
    answers_.clear();
    core_.advance_to(time_us, answers_);
  }

  void run_free_if_alone() {
    if (tick_ == 0 || wall_us() - heard_us_ < kMasterGone_us) {
      running_free_ = false;
      return;
    }
    if (!running_free_) {
      running_free_ = true;
      free_us_ = tick_ * cycle_us_;
      for (LockstepLink& link : links_) {
        (void)link.take_outsiders();  // of the time when there was a master
      }
      tell_not_deterministic();
    }
    free_us_ += kFreeStep_us;
    for (std::size_t bus = 0; bus < links_.size(); ++bus) {
      for (const CanFrame& frame : links_[bus].take_outsiders()) {
        core_.receive(static_cast<int>(bus), frame, free_us_);
      }
    }
    advance(free_us_);
    for (const BusFrame& frame : answers_) {
      links_[frame.bus].send_unstamped(frame.frame);
    }
    shell_.publish();
  }

  void tell_not_deterministic() {
    const std::string note = std::string("no SYNC for a second, time goes on by the wall clock: ") +
                             kNotDeterministicNote;
    process_.set_standing_note(note);
    log_warn(note);
  }

  Process& process_;
  const std::int64_t cycle_us_;
  SimCore core_;
  SimShell shell_;
  std::vector<LockstepLink> links_;
  std::vector<pollfd> fds_;
  FrameBatch burst_;
  FrameBatch answers_;
  std::int64_t tick_ = 0;
  std::int64_t heard_us_ = 0;
  std::int64_t free_us_ = 0;
  bool running_free_ = false;
};

}  // namespace

int run_sim_lockstep(Process& process, const SimProgramOptions& options) {
  return LockstepSim(process, options).run();
}

}  // namespace sprung
