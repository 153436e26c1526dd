#include <poll.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/bridge/bridge_shell.h"
#include "drivers/can/bus_addresses.h"
#include "drivers/can/can_bus.h"
#include "drivers/can/can_errors.h"
#include "drivers/canopen/protocol.h"
#include "runtime/log.h"
#include "runtime/stop_request.h"

namespace sprung {

namespace {

/// Share of the cycle after which the drives' answers are no longer waited for.
constexpr double kAnswerShare = 0.5;

constexpr int kFullRead = 64;
constexpr int kLongestLook = 8;  // a bus that is flooded must not keep the cycle from its deadline

/// Absolute deadlines; a cycle that begins more than one cycle late is an overrun, and the missed ones are
/// skipped.
class RealTimeBridge {
 public:
  RealTimeBridge(Process& process, const BridgeProgramOptions& options)
      : process_(process),
        cycles_(options.cycles),
        cycle_us_(std::llround(process.robot().cycle_s * 1e6)),
        core_(process.robot(), BridgeOptions{process.watchdogs()}),
        shell_(process, core_),
        state_(process.robot().actuators.size()),
        command_(process.robot().actuators.size()) {
    for (const std::string& address : bus_addresses(process.robot(), options.can)) {
      buses_.push_back(open_can_bus(address));
      fds_.push_back({buses_.back()->fd(), POLLIN, 0});
    }
    fds_.push_back({process.node().event_fd(), POLLIN, 0});
  }

  int run() {
    const Receiving receiving(process_.node());
    process_.set_state(ProcessState::kReady);
    std::int64_t deadline_us = now_us() + cycle_us_;
    while (!core_.shut_down()) {
      wait_until(deadline_us, [] { return false; });
      count_lateness(deadline_us);
      run_cycle(deadline_us);
      follow_stop();
      process_.publish_status_if_due();
      deadline_us += cycle_us_;
    }
    return 0;
  }

 private:
  std::int64_t now_us() const { return process_.node().utime_us(); }

  void count_lateness(std::int64_t& deadline_us) {
    const std::int64_t late_us = now_us() - deadline_us;
    if (late_us <= cycle_us_) {
      core_.count_good_cycle();
      return;
    }
    core_.count_overrun(now_us());
    deadline_us += late_us / cycle_us_ * cycle_us_;
  }

  void run_cycle(std::int64_t deadline_us) {
    process_.statistics().begin_cycle(now_us());
    shell_.serve_operators(now_us());
    core_.begin_tick(now_us(), out_);
    send();
    const auto window_us = static_cast<std::int64_t>(kAnswerShare * static_cast<double>(cycle_us_));
    const std::int64_t answers_us =
        std::max(deadline_us, now_us()) + window_us;  // in full also after a late start
    wait_until(answers_us, [this] { return core_.all_answered(); });
    if (core_.end_sampling(now_us(), state_)) {
      shell_.publish_cycle(state_);
      shell_.follow_start();
      wait_until(deadline_us + cycle_us_, [this] { return shell_.has_command(state_.stamp.seq); });
      if (!shell_.has_command(state_.stamp.seq)) {
        core_.count_missed_cycle();
      }
    } else {
      shell_.publish_boot();
    }
    core_.emit_setpoints(now_us(), out_);
    send();
    process_.statistics().end_cycle(now_us());
  }

  void send() {
    for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
      int count = 0;
      for (const BusFrame& frame : out_) {
        if (frame.bus == static_cast<int>(bus)) {
          sending_[static_cast<std::size_t>(count++)] = frame.frame;
        }
      }
      // The queue to the bus is first in, first out: SYNC must not wait behind heartbeats, its jitter is the encoders' noise.
      const auto sent = sending_.begin() + count;
      const auto sync =
          std::find_if(sending_.begin(), sent, [](const CanFrame& f) { return f.id == canopen::kSyncId; });
      if (sync != sent) {
        std::rotate(sending_.begin(), sync, sync + 1);
      }
      if (count > 0 && !buses_[bus]->send(sending_.data(), count)) {
        core_.receive(static_cast<int>(bus), bus_lost_frame(),
                      now_us());  // ENOBUFS or link down: design section 8
      }
    }
    shell_.trace(out_, true, now_us());
    out_.clear();
  }

  /// Takes frames and commands as they come until `done` or the deadline.
  template <class Done>
  void wait_until(std::int64_t deadline_us, Done done) {
    while (true) {
      receive();
      const std::int64_t left_us = deadline_us - now_us();
      if (left_us <= 0 || done()) {
        return;
      }
      const timespec left{left_us / 1'000'000, left_us % 1'000'000 * 1000};
      ppoll(fds_.data(), fds_.size(), &left, nullptr);
    }
  }

  void receive() {
    for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
      int count = kFullRead;
      for (int look = 0; look < kLongestLook && count == kFullRead; ++look) {
        count = buses_[bus]->receive(received_.data(), kFullRead);
        for (int i = 0; i < count; ++i) {
          const CanFrame& frame = received_[static_cast<std::size_t>(i)];
          core_.receive(static_cast<int>(bus), frame, now_us());
          shell_.trace(static_cast<int>(bus), frame, false, now_us());
        }
      }
    }
    process_.node().clear_event();
    if (shell_.take_command(command_)) {
      core_.command(command_, now_us());
    }
  }

  void follow_stop() {
    const bool at_end = cycles_ > 0 && state_.stamp.seq + 1 >= cycles_;
    if ((stop_requested() || at_end) && !stopping_) {
      stopping_ = true;
      core_.begin_shutdown(now_us());
    }
  }

  Process& process_;
  const std::int64_t cycles_;
  const std::int64_t cycle_us_;
  BridgeCore core_;
  BridgeShell shell_;
  std::vector<std::unique_ptr<CanBus>> buses_;
  std::vector<pollfd> fds_;
  FrameBatch out_;
  std::array<CanFrame, FrameBatch::kCapacity> sending_{};
  std::array<CanFrame, kFullRead> received_{};
  DriveState state_;
  DriveCommand command_;
  bool stopping_ = false;
};

}  // namespace

int run_bridge_realtime(Process& process, const BridgeProgramOptions& options) {
  return RealTimeBridge(process, options).run();
}

}  // namespace sprung
