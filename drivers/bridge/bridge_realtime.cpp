#include <poll.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "drivers/bridge/bridge_shell.h"
#include "drivers/bridge/foreign_master_watch.h"
#include "drivers/can/bus_addresses.h"
#include "drivers/can/can_bus.h"
#include "drivers/can/can_filter.h"
#include "drivers/can/can_interface.h"
#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"
#include "drivers/canopen/sdo_frames.h"
#include "runtime/host_lock.h"
#include "runtime/log.h"
#include "runtime/stop_request.h"

namespace sprung {

namespace {

/// Share of the cycle after which the drives' answers are no longer waited for.
constexpr double kAnswerShare = 0.5;

constexpr int kFullRead = 64;
constexpr int kLongestLook = 8;  // a bus that is flooded must not keep the cycle from its deadline

// CiA 301 frames with 11-bit identifier and no stuff bits, the space after them included.
constexpr double kSync_bits = 47.0;
constexpr double kAnswer_bits = 111.0;  // 8 bytes, as every profile's TPDO1

constexpr std::int64_t kSendErrorInterval_us = 1'000'000;

/// [design choice] Before the first frame of ours: many SYNCs and heartbeats of whoever is master already.
constexpr std::int64_t kListen_us = 100'000;
constexpr std::int64_t kAnswer_us = 20'000;  ///< [design choice] drives answer within milliseconds

bool is_node(const RobotConfig& robot, int bus, int node) {
  const auto it = [bus, node](const auto& device) { return device.bus == bus && device.node == node; };
  return std::any_of(robot.actuators.begin(), robot.actuators.end(), it) ||
         std::any_of(robot.encoder_cards.begin(), robot.encoder_cards.end(), it);
}

/// Nodes that answer SYNC on one bus.
int count_nodes(const RobotConfig& robot, int bus) {
  const auto here = [bus](const auto& device) { return device.bus == bus; };
  return static_cast<int>(std::count_if(robot.actuators.begin(), robot.actuators.end(), here) +
                          std::count_if(robot.encoder_cards.begin(), robot.encoder_cards.end(), here));
}

SendFailure failure_of(CanSendError error) {
  switch (error) {
    case CanSendError::kNoBuffers:
      return SendFailure::kNoBuffers;
    case CanSendError::kLinkDown:
      return SendFailure::kLinkDown;
    default:
      return SendFailure::kOther;
  }
}

/// Absolute deadlines; a cycle that begins more than one cycle late is an overrun, and the missed ones are
/// skipped.
class RealTimeBridge {
 public:
  RealTimeBridge(Process& process, const BridgeProgramOptions& options)
      : process_(process),
        cycles_(options.cycles),
        cycle_us_(std::llround(process.robot().cycle_s * 1e6)),
        core_(with_bus_addresses(process.robot(), options.can), BridgeOptions{process.watchdogs()}),
        shell_(process, core_),
        state_(process.robot().actuators.size()),
        command_(process.robot().actuators.size()) {
    for (const std::string& address : bus_addresses(process.robot(), options.can)) open_bus(address);
    fds_.push_back({process.node().event_fd(), POLLIN, 0});
    send_errors_.assign(buses_.size(), LogLimit(kSendErrorInterval_us));
  }

  int run() {
    const Receiving receiving(process_.node());
    listen();
    process_.set_state(ProcessState::kReady);
    std::int64_t deadline_us = now_us() + cycle_us_;
    while (!core_.shut_down()) {
      wait_until(deadline_us, Wake::kOnCommands, [] { return false; });
      count_lateness(deadline_us);
      run_cycle(deadline_us);
      follow_stop();
      process_.publish_status_if_due();
      deadline_us += cycle_us_;
    }
    shell_.report_end();
    return 0;
  }

 private:
  /// What ends a sleep. Frames that come when nothing is done about them before the next deadline wait in the
  /// kernel, which has stamped them.
  enum class Wake : std::int8_t { kOnFramesAndCommands, kOnCommands };

  std::int64_t now_us() const { return process_.node().utime_us(); }

  /// Sends nothing but, at the end, a question to whoever has the bridge's own node id: a drive as it was
  /// delivered may, and keeps silent until it is asked. @throws std::runtime_error when there is one, or
  /// another master speaks on one of the buses.
  void listen() {
    listen_until(now_us() + kListen_us);
    const CanFrame question = canopen::sdo_read_request(canopen::kBridgeNode, {canopen::kDeviceType, 0});
    for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
      if (buses_[bus]->send(&question, 1)) shell_.trace(static_cast<int>(bus), question, true, now_us());
    }
    listen_until(now_us() + kAnswer_us);
  }

  void listen_until(std::int64_t end_us) {
    while (now_us() < end_us) {
      sleep_until(end_us, fds_.data(), buses_.size());
      for (std::size_t bus = 0; bus < buses_.size(); ++bus) listen(static_cast<int>(bus));
    }
  }

  void listen(int bus) {
    const int count = buses_[bus]->receive(received_.data(), kFullRead);
    for (int i = 0; i < count; ++i) {
      const int node = static_cast<int>(received_[i].id & 0x7FU);
      const MasterFrame kind = master_frame(received_[i], is_node(process_.robot(), bus, node));
      if (kind == MasterFrame::kNone) continue;
      throw std::runtime_error("bus " + process_.robot().buses[bus].name + " (" + buses_[bus]->describe() +
                               "): somebody else speaks there as a master does: " + text(kind) +
                               "; nothing was commanded. " + remedy(kind));
    }
  }

  void open_bus(const std::string& address) {
    const int bus = static_cast<int>(buses_.size());
    locks_.emplace_back("bus/" + address, "bus " + process_.robot().buses[bus].name + " (" + address + ")");
    buses_.push_back(open_can_bus(address));
    fds_.push_back({buses_.back()->fd(), POLLIN, 0});
    const std::vector<CanFilter> filters = bus_filters(process_.robot(), bus);
    buses_.back()->accept_only(filters.data(), static_cast<int>(filters.size()));
    const std::optional<InterfaceFacts> facts = read_interface(address);
    if (!facts) return;
    if (process_.options().simulation) require_virtual(*facts);
    const int nodes = count_nodes(process_.robot(), bus);
    const int frames_per_cycle = 2 + 2 * nodes;  // SYNC, heartbeat, and set-point and control word for each
    const int bit_rate = static_cast<int>(std::lround(process_.robot().bit_rate_bit_s));
    check_bit_rate(*facts, bit_rate);
    for (const std::string& advice : interface_advice(*facts, frames_per_cycle, bit_rate)) log_warn(advice);
    if (facts->bit_rate == 0) return;
    const double wire_us = 1e6 * (kSync_bits + kAnswer_bits * nodes) / facts->bit_rate;
    wire_us_ = std::max(wire_us_, static_cast<std::int64_t>(wire_us));
  }

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
    const std::int64_t answers_us = std::max(deadline_us, now_us()) +
                                    window_us;  // in full also after a late start
    // The last answer cannot be there before the wire has carried them all: one wake-up instead of one a
    // frame.
    if (core_.operational()) sleep_until(std::min(now_us() + wire_us_, answers_us), nullptr, 0);
    wait_until(answers_us, Wake::kOnFramesAndCommands, [this] { return core_.all_answered(); });
    count_traffic();
    if (core_.end_sampling(now_us(), state_)) {
      shell_.publish_cycle(state_);
      shell_.follow_start();
      wait_until(deadline_us + cycle_us_, Wake::kOnCommands,
                 [this] { return shell_.has_command(state_.stamp.seq); });
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

  void count_traffic() {
    for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
      shell_.count_traffic(static_cast<int>(bus), buses_[bus]->counters());
    }
  }

  void send() {
    for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
      const int count = frames_of_bus(out_, static_cast<int>(bus), sending_.data());
      // The queue to the bus is first in, first out: SYNC must not wait behind heartbeats, its jitter is the
      // encoders' noise.
      const auto sent = sending_.begin() + count;
      const auto sync = std::find_if(sending_.begin(), sent,
                                     [](const CanFrame& f) { return f.id == canopen::kSyncId; });
      if (sync != sent) {
        std::rotate(sending_.begin(), sync, sync + 1);
      }
      if (count > 0) send(bus, count);
    }
    out_.clear();
  }

  /// The trace holds what the bus took, in the order in which it took it.
  void send(std::size_t bus, int count) {
    const std::int64_t before = buses_[bus]->counters().sent;
    if (!buses_[bus]->send(sending_.data(), count)) report_send_error(bus);
    const auto taken = static_cast<std::size_t>(buses_[bus]->counters().sent - before);
    for (std::size_t i = 0; i < taken; ++i) {
      shell_.trace(static_cast<int>(bus), sending_[i], true, now_us());
    }
  }

  /// Design section 8: this cycle's set-points are lost; when that lasts, the bus is.
  void report_send_error(std::size_t bus) {
    const CanSendError error = buses_[bus]->last_send_error();
    core_.send_failed(static_cast<int>(bus), failure_of(error), now_us());
    LogLimit& limit = send_errors_[bus];
    if (!limit.allow(now_us())) return;
    const std::int64_t more = limit.kept_back();
    log_warn(buses_[bus]->describe() + ": " + text(error) +
             (more > 0 ? "; and " + std::to_string(more) + " times since the last such line" : ""));
  }

  /// Takes frames and commands as they come until `done` or the deadline.
  template <class Done>
  void wait_until(std::int64_t deadline_us, Wake wake, Done done) {
    const std::size_t unwatched = wake == Wake::kOnCommands ? buses_.size() : 0;
    while (true) {
      receive();
      if (now_us() >= deadline_us || done()) {
        return;
      }
      sleep_until(deadline_us, fds_.data() + unwatched, fds_.size() - unwatched);
    }
  }

  void sleep_until(std::int64_t time_us, pollfd* fds, std::size_t count) {
    const std::int64_t left_us = time_us - now_us();
    if (left_us <= 0) return;
    const timespec left{left_us / 1'000'000, left_us % 1'000'000 * 1000};
    ppoll(fds, count, &left, nullptr);
  }

  void receive() {
    for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
      int count = kFullRead;
      for (int look = 0; look < kLongestLook && count == kFullRead; ++look) {
        count = buses_[bus]->receive_timed(received_.data(), arrivals_us_.data(), kFullRead);
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
          const std::int64_t came_us = std::min(arrivals_us_[i] - process_.node().clock().epoch_us(),
                                                now_us());
          core_.receive(static_cast<int>(bus), received_[i], came_us);
          shell_.trace(static_cast<int>(bus), received_[i], false, came_us);
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
  std::vector<HostLock> locks_;
  std::vector<std::unique_ptr<CanBus>> buses_;
  std::vector<pollfd> fds_;
  FrameBatch out_;
  std::array<CanFrame, FrameBatch::kCapacity> sending_{};
  std::array<CanFrame, kFullRead> received_{};
  std::array<std::int64_t, kFullRead> arrivals_us_{};
  std::vector<LogLimit> send_errors_;
  std::int64_t wire_us_ = 0;  ///< that SYNC and all answers need on the slowest bus; 0 = not known
  DriveState state_;
  DriveCommand command_;
  bool stopping_ = false;
};

}  // namespace

int run_bridge_realtime(Process& process, const BridgeProgramOptions& options) {
  return RealTimeBridge(process, options).run();
}

}  // namespace sprung
