/// sprung-imu-driver: a serial Xsens MTi in, IMU out; robot.yaml's body.imu_driver says which line and how
/// the sensor is mounted. DRIVE_STATE tells it the cycle. In real time only.
#include <poll.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "drivers/imu/imu_core.h"
#include "drivers/imu/serial_port.h"
#include "lcmtypes/channels.h"
#include "runtime/process.h"
#include "runtime/stop_request.h"
#include "signals/drive_state.h"

namespace sprung {
namespace {

constexpr std::int64_t kTurn_us = 2'000;      // silence is looked at this often
constexpr std::int64_t kReopen_us = 500'000;  // between attempts to open a line that is gone

class ImuDriver {
 public:
  explicit ImuDriver(Process& process)
      : process_(process),
        config_(process.robot().body.imu_driver),
        core_(config_, process.robot().cycle_s),
        port_(config_.device, config_.baud),
        drive_state_(process.robot().actuators.size()),
        drive_states_(drive_state_),
        imus_(process.node().publisher<Imu>(channels::kImu)) {
    process.node().subscribe(channels::kDriveState, CountLimits::exactly(process.robot().actuators.size()),
                             drive_states_);
    port_.open();
  }

  int run() {
    const Receiving receiving(process_.node());
    process_.set_state(ProcessState::kReady);
    while (!stop_requested()) {
      wait();
      process_.statistics().begin_cycle(now_us());
      if (drive_states_.newest(drive_state_)) core_.cycle(drive_state_.stamp);
      read();
      if (core_.watch(now_us(), imu_)) imus_.publish(imu_);
      process_.statistics().end_cycle(now_us());
      show();
    }
    return 0;
  }

 private:
  std::int64_t now_us() const { return process_.node().utime_us(); }

  void wait() {
    std::array<pollfd, 2> fds{{{process_.node().event_fd(), POLLIN, 0}, {port_.fd(), POLLIN, 0}}};
    ::poll(fds.data(), port_.is_open() ? 2 : 1, static_cast<int>(kTurn_us / 1000));
    process_.node().clear_event();
    if ((fds[1].revents & (POLLHUP | POLLERR | POLLNVAL)) != 0 && (fds[1].revents & POLLIN) == 0)
      port_.close();
  }

  void read() {
    if (!port_.is_open()) return reopen();
    std::array<std::uint8_t, 512> bytes;
    for (int count; (count = port_.read(bytes.data(), static_cast<int>(bytes.size()))) > 0;) {
      const std::int64_t arrival_us = now_us();
      for (int i = 0; i < count; ++i) {
        if (core_.take(bytes[static_cast<std::size_t>(i)], arrival_us, imu_)) publish();
      }
    }
  }

  void reopen() {
    if (now_us() < next_try_us_) return;
    next_try_us_ = now_us() + kReopen_us;
    if (port_.try_open()) core_.restart();
  }

  void publish() {
    imus_.publish(imu_);
    process_.status().stamp.seq = imu_.stamp.seq;
    process_.status().input_age_us = static_cast<double>(now_us() - imu_.stamp.utime_us);
    if (process_.status().state == ProcessState::kReady) process_.set_state(ProcessState::kRunning);
  }

  void show() {
    process_.status().sequence_gaps = core_.counters().lost;
    process_.status().detail = detail();
    process_.publish_status_if_due();
  }

  /// What is wrong now, and what was.
  std::string detail() {
    const bool strange = core_.not_understood(now_us());
    std::string text;
    if (!port_.is_open()) {
      text = config_.device + " is gone: is the sensor plugged in?";
    } else if (strange) {
      text = "bytes on " + config_.device + " but no message: is the baud rate " +
             std::to_string(config_.baud) + " the sensor's, and does it send MTData2?";
    } else if (core_.silent()) {
      text = "the sensor is silent: is it measuring?";
    }
    const imu::ImuCounters& c = core_.counters();
    const auto add = [&text](const char* what, std::int64_t count) {
      if (count > 0) text += (text.empty() ? "" : "; ") + std::string(what) + " " + std::to_string(count);
    };
    add("silences", c.silences);
    add("messages lost", c.lost);
    add("bad checksums", core_.line().bad_checksums);
    add("malformed", c.malformed);
    add("without rate or force", c.incomplete);
    add("clipped", c.clipped);
    add("not finite", c.not_finite);
    return text;
  }

  Process& process_;
  const ImuDriverConfig& config_;
  imu::ImuCore core_;
  imu::SerialPort port_;
  DriveState drive_state_;
  Slot<DriveState> drive_states_;
  Publisher<Imu> imus_;
  Imu imu_;
  std::int64_t next_try_us_ = 0;
};

int drive_imu(Process& process) {
  if (process.robot().body.imu_driver.device.empty()) {
    throw std::invalid_argument("robot.yaml of " + process.robot().name +
                                " has no body.imu_driver: say which line the sensor hangs on, or take "
                                "sprung-imu-driver out of its processes");
  }
  if (process.lockstep())
    throw std::invalid_argument(
        "a real IMU keeps real time: use --clock realtime, or --sim for a simulated one");
  return ImuDriver(process).run();
}

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) {
  return sprung::run_process(argc, argv, {"sprung-imu-driver", "A serial IMU (Xsens MTi)."},
                             sprung::drive_imu);
}
