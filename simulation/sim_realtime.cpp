#include <poll.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <optional>

#include "drivers/can/bus_addresses.h"
#include "drivers/can/can_interface.h"
#include "runtime/host_lock.h"
#include "runtime/stop_request.h"
#include "simulation/sim_shell.h"

namespace sprung {

namespace {

constexpr std::int64_t kStep_us = 1'000;  // how far the plant may lag behind the clock between frames
constexpr std::int64_t kLag_us = 300;     // keeps room for a frame that has arrived and was not read yet

class RealTimeSim {
 public:
  RealTimeSim(Process& process, const SimProgramOptions& options)
      : process_(process), core_(process.robot(), options.sim), shell_(process, core_, options.sim.truth) {
    for (const std::string& address : bus_addresses(process.robot(), options.can)) {
      locks_.emplace_back("drives/" + address, "bus " + address);  // two robots would answer one bridge
      const std::optional<InterfaceFacts> facts = read_interface(address);
      if (facts && process.options().simulation) require_virtual(*facts);
      buses_.push_back(open_can_bus(address));
      fds_.push_back({buses_.back()->fd(), POLLIN, 0});
    }
  }

  int run() {
    const Receiving receiving(process_.node());
    process_.set_state(ProcessState::kReady);
    std::int64_t deadline_us = now_us();
    while (!stop_requested()) {
      wait_until(deadline_us);
      process_.statistics().begin_cycle(now_us());
      shell_.take_controls();
      receive();
      advance(std::max(now_us() - kLag_us, newest_frame_us_));
      shell_.publish();
      process_.statistics().end_cycle(now_us());
      process_.publish_status_if_due();
      if (now_us() >= deadline_us) {
        deadline_us += ((now_us() - deadline_us) / kStep_us + 1) * kStep_us;
      }
    }
    return 0;
  }

 private:
  std::int64_t now_us() const { return process_.node().utime_us(); }

  void wait_until(std::int64_t deadline_us) {
    const std::int64_t left_us = deadline_us - now_us();
    if (left_us > 0) {
      const timespec left{0, left_us * 1000};
      ppoll(fds_.data(), fds_.size(), &left, nullptr);
    }
  }

  /// Frames act when they reached the kernel, as they would in a drive, not when this process woke up.
  void receive() {
    for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
      const int capacity = static_cast<int>(received_.size());
      for (int count = 0;
           (count = buses_[bus]->receive_timed(received_.data(), arrivals_us_.data(), capacity)) > 0;) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
          const std::int64_t acts_us = arrivals_us_[i] - process_.node().clock().epoch_us();
          core_.receive(static_cast<int>(bus), received_[i], acts_us);
          newest_frame_us_ = std::max(newest_frame_us_, acts_us);
        }
      }
    }
  }

  void advance(std::int64_t time_us) {
    answers_.clear();
    core_.advance_to(time_us, answers_);
    for (std::size_t bus = 0; bus < buses_.size(); ++bus) {
      const int count = frames_of_bus(answers_, static_cast<int>(bus), sending_.data());
      if (count > 0) buses_[bus]->send(sending_.data(), count);
    }
  }

  Process& process_;
  SimCore core_;
  SimShell shell_;
  std::vector<HostLock> locks_;
  std::vector<std::unique_ptr<CanBus>> buses_;
  std::vector<pollfd> fds_;
  std::array<CanFrame, 64> received_{};
  std::array<std::int64_t, 64> arrivals_us_{};
  std::int64_t newest_frame_us_ = 0;
  FrameBatch answers_;
  std::array<CanFrame, FrameBatch::kCapacity> sending_{};
};

}  // namespace

int run_sim_realtime(Process& process, const SimProgramOptions& options) {
  return RealTimeSim(process, options).run();
}

}  // namespace sprung
