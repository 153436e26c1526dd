#include "simulation/sim_core.h"

#include <algorithm>
#include <cmath>

#include "drivers/canopen/protocol.h"
#include "simulation/bus_faults.h"
#include "simulation/bus_schedule.h"
#include "simulation/computer.h"
#include "simulation/plant/drive_train.h"
#include "simulation/plant/experimenter.h"
#include "simulation/plant/imu_sensor.h"

namespace sprung {
namespace {

constexpr int kPacingBus = 0;  ///< its SYNC counts the cycles

std::int64_t microseconds(double seconds) { return std::llround(1e6 * seconds); }

bool is_sync(const CanFrame& frame) noexcept { return !frame.error && frame.id == canopen::kSyncId; }

/// An RPDO of the predefined connection set (facts canopen 1.1).
bool is_setpoint(const CanFrame& frame) noexcept {
  constexpr std::uint32_t kFunction = 0x780, kFirst = 0x200, kLast = 0x500;
  const std::uint32_t function = frame.id & kFunction;
  return !frame.error && function >= kFirst && function <= kLast && (function & 0x80U) == 0;
}

}  // namespace

struct SimCore::Impl {
  Impl(const RobotConfig& robot, const SimOptions& options)
      : Impl(robot, options, sim::load_sim_config(robot, options.plant)) {}
  Impl(const RobotConfig& robot, const SimOptions& options, const sim::SimConfig& config)
      : train(robot, config, options.seed, options.wiring),
        bus_faults(robot.buses.size()),
        imu(config.imu.value_or(sim::ImuConfig{}), options.seed),
        with_imu(config.imu.has_value()),
        experimenter(train, bus_faults, imu),
        computer(config.timing, options.seed),
        schedule(robot.buses.size()),
        step_us(microseconds(config.plant.step_s)),
        torque_sensor(config.torque_sensor.value_or(sim::TorqueSensorConfig{}), options.seed),
        with_truth(options.truth),
        runs_from_power_on(options.runs_from_power_on),
        truth(robot.joints.size(), robot.legs.size()) {}

  void queue(std::int64_t time_us, int bus, const CanFrame& frame) noexcept;
  void advance_to(std::int64_t time_us, FrameBatch& out) noexcept;
  void act(const sim::TimedFrame& event, FrameBatch& out) noexcept;
  void deliver(const sim::TimedFrame& event) noexcept;
  void sync(const sim::TimedFrame& event) noexcept;
  void step_until(std::int64_t time_us) noexcept;
  void tick_drives() noexcept;
  void step_plant() noexcept;

  sim::DriveTrain train;
  sim::BusFaults bus_faults;
  sim::ImuSensor imu;
  bool with_imu;
  sim::Experimenter experimenter;
  sim::Computer computer;
  sim::BusSchedule schedule;
  sim::FrameQueue frames;
  std::int64_t step_us;
  sim::TorqueSensorDevice torque_sensor;
  bool with_truth;
  bool runs_from_power_on;
  SimTruth truth;
  std::int64_t cycle = -1;
  std::int64_t plant_us = -1;   ///< time of the plant's state, on the grid of steps; -1 = not begun
  std::int64_t running_us = 0;  ///< since cycle 0
  bool ticked = false;          ///< the drives' loops have run at plant_us
  const char* failure = nullptr;
};

void SimCore::Impl::queue(std::int64_t time_us, int bus, const CanFrame& frame) noexcept {
  if (!frames.push({std::max(time_us, plant_us), bus, frame}))
    failure = "more frames waiting than SimCore keeps";
}

void SimCore::Impl::tick_drives() noexcept {
  if (!ticked) train.step_drives(plant_us);
  ticked = true;
}

void SimCore::Impl::step_plant() noexcept {
  train.step_plant();
  experimenter.after_step();
  running_us += step_us;
  if (torque_sensor.due(running_us))
    torque_sensor.read({plant_us, cycle}, train.plant().gear_output_torque_Nm(torque_sensor.joint()));
}

/// The loops at a grid time see what acted until then; the plant then moves on under their torques. Held
/// before cycle 0.
void SimCore::Impl::step_until(std::int64_t time_us) noexcept {
  while (plant_us + step_us <= time_us) {
    tick_drives();
    plant_us += step_us;
    if (cycle >= 0 || runs_from_power_on) step_plant();
    ticked = false;
  }
  if (time_us > plant_us) tick_drives();
}

void SimCore::Impl::advance_to(std::int64_t time_us, FrameBatch& out) noexcept {
  if (plant_us < 0) plant_us = std::min(time_us, frames.next_us()) / step_us * step_us;
  time_us = std::max(time_us, plant_us);
  train.open(&out);
  while (frames.next_us() <= time_us) {
    step_until(frames.next_us());
    act(frames.pop(), out);
  }
  step_until(time_us);
  train.open(nullptr);
  bus_faults.report(out);
}

void SimCore::Impl::act(const sim::TimedFrame& event, FrameBatch& out) noexcept {
  if (!is_sync(event.frame)) return deliver(event);
  const int sent_before = out.size();
  sync(event);
  schedule.start_answers(event.bus);
  for (int i = sent_before; i < out.size(); ++i) schedule.add_answer(out[i]);
}

void SimCore::Impl::deliver(const sim::TimedFrame& event) noexcept {
  if (bus_faults.delivers(event.bus)) train.receive(event.bus, event.frame, event.time_us);
}

void SimCore::Impl::sync(const sim::TimedFrame& event) noexcept {
  if (event.bus == kPacingBus) {
    if (cycle >= 0 || runs_from_power_on || train.all_operational()) ++cycle;
    experimenter.start_cycle(cycle);
  }
  train.sample(event.bus, 1e-6 * static_cast<double>(event.time_us - plant_us), cycle);
  bus_faults.sync(event.bus);
  deliver(event);
  if (event.bus != kPacingBus) return;
  const Stamp stamp{event.time_us, cycle};
  if (with_imu && cycle >= 0)
    imu.sample(train.plant().base_motion(), stamp, 1e-6 * static_cast<double>(running_us));
  if (!with_truth) return;
  truth.stamp = stamp;
  train.plant().fill_truth(truth);
}

SimCore::SimCore(const RobotConfig& robot, const SimOptions& options)
    : impl_(std::make_unique<Impl>(robot, options)) {}

SimCore::~SimCore() = default;

void SimCore::receive(int bus, const CanFrame& frame, std::int64_t time_us) noexcept {
  impl_->queue(time_us, bus, frame);
}

void SimCore::advance_to(std::int64_t time_us, FrameBatch& out) noexcept { impl_->advance_to(time_us, out); }

void SimCore::receive_burst(const FrameBatch& burst, std::int64_t last_sync_us,
                            std::int64_t sync_us) noexcept {
  impl_->schedule.start_burst(last_sync_us, impl_->computer.compute_us(impl_->cycle),
                              impl_->computer.may_be_late(impl_->cycle));
  const bool missed = impl_->computer.misses(impl_->cycle);
  for (const BusFrame& entry : burst) {
    if (missed && is_setpoint(entry.frame)) continue;
    const std::int64_t time_us = is_sync(entry.frame) ? sync_us : impl_->schedule.acts_us(entry, sync_us);
    impl_->queue(time_us, entry.bus, entry.frame);
  }
}

void SimCore::control(const SimControl& control) noexcept {
  if (!impl_->experimenter.add(control)) impl_->failure = "more SIM_CONTROL waiting than SimCore keeps";
}

std::int64_t SimCore::cycle() const noexcept { return impl_->cycle; }

const SimTruth& SimCore::truth() const noexcept { return impl_->truth; }

std::int64_t SimCore::torque_reading_count() const noexcept { return impl_->torque_sensor.count(); }

const TorqueSensor& SimCore::torque_reading(std::int64_t n) const noexcept {
  return impl_->torque_sensor.sample(n);
}

const TorqueSensor& SimCore::torque_sensor() const noexcept {
  return torque_reading(std::max<std::int64_t>(0, torque_reading_count() - 1));
}

const Imu& SimCore::imu() const noexcept { return impl_->imu.newest(); }

double SimCore::true_motor_torque_Nm(int actuator) noexcept {
  const sim::SimDrive* drive = impl_->train.drive(actuator);
  return drive != nullptr ? drive->motor_torque_Nm() : 0.0;
}

double SimCore::true_winding_V(int actuator) noexcept {
  const sim::SimDrive* drive = impl_->train.drive(actuator);
  return drive != nullptr ? drive->winding_state().voltage_V : 0.0;
}

double SimCore::true_supply_V() const noexcept {
  return impl_->train.supply() ? impl_->train.supply()->voltage_V() : kNaN;
}

double SimCore::true_load_Nm(int joint) const noexcept {
  return impl_->train.plant().load_Nm(static_cast<std::size_t>(joint));
}

double SimCore::true_position_rad(int joint) const noexcept {
  return impl_->train.plant().position_rad(static_cast<std::size_t>(joint));
}

void SimCore::push_joint(int joint, double torque_Nm) noexcept {
  impl_->train.plant().push_joint(joint, torque_Nm);
}

bool SimCore::failed() const noexcept { return impl_->failure != nullptr || impl_->train.plant().failed(); }

const char* SimCore::failure() const noexcept {
  return impl_->failure != nullptr ? impl_->failure : impl_->train.plant().failure();
}

}  // namespace sprung
