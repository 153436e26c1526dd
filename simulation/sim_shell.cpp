#include "simulation/sim_shell.h"

#include <algorithm>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "simulation/plant/torque_sensor.h"

namespace sprung {

SimShell::SimShell(Process& process, SimCore& core, bool truth)
    : process_(process),
      core_(core),
      truth_(truth),
      truths_(process.node().publisher<SimTruth>(channels::kSimTruth)),
      imus_(process.node().publisher<Imu>(channels::kImu)),
      imu_is_awaited_(process.lockstep() && process.robot().body.imu),
      torque_readings_(process.node().publisher<TorqueSensor>(channels::kTorqueSensor)) {
  process.node().subscribe(channels::kSimControl, CountLimits::none(), controls_);
}

void SimShell::take_controls() {
  while (const std::optional<SimControl> control = controls_.pop()) {
    if (repeated_.is_new(control->stamp)) core_.control(*control);
  }
}

/// After a stall of real time there may be more than the core keeps: the oldest are lost, as on a serial
/// line.
void SimShell::publish_torque_readings() {
  const std::int64_t count = core_.torque_reading_count();
  const std::int64_t oldest = count - sim::TorqueSensorDevice::kKept;
  for (std::int64_t n = std::max(torque_readings_published_, oldest); n < count; ++n) {
    torque_readings_.publish(core_.torque_reading(n));
  }
  torque_readings_published_ = count;
}

void SimShell::publish_imu(std::int64_t sync_us) {
  const bool measured = core_.imu().stamp.seq == core_.cycle();
  if (core_.cycle() <= imu_.stamp.seq || !(measured || imu_is_awaited_)) return;
  imu_ = measured ? core_.imu() : Imu{};
  imu_.stamp = {measured ? imu_.stamp.utime_us : sync_us, core_.cycle()};
  imus_.publish(imu_);
}

void SimShell::repeat() {
  if (imu_.stamp.seq >= 0 && imu_.stamp.seq == core_.cycle()) imus_.publish(imu_);
}

void SimShell::publish() {
  if (core_.failed()) {
    throw std::runtime_error(std::string("the simulated plant failed, the run is void: ") + core_.failure());
  }
  if (truth_ && core_.cycle() > published_cycle_) {
    truths_.publish(core_.truth());
  }
  publish_imu(process_.node().utime_us());
  publish_torque_readings();
  if (core_.cycle() >= 0 && published_cycle_ < 0) {
    process_.set_state(ProcessState::kRunning);
  }
  published_cycle_ = core_.cycle();
  process_.status().stamp = core_.truth().stamp;
}

}  // namespace sprung
