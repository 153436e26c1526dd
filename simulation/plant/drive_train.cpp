#include "simulation/plant/drive_train.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "drivers/canopen/nmt.h"
#include "robots/robot_loader.h"
#include "simulation/device_registry.h"
#include "simulation/hash_noise.h"

namespace sprung::sim {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Noise sources of actuator i: torque 2 i, instant of sampling 2 i + 1; its link encoder's are counted
/// apart.
std::uint64_t torque_signal(std::size_t actuator) noexcept { return 2 * actuator; }
std::uint64_t jitter_signal(std::size_t actuator) noexcept { return 2 * actuator + 1; }
constexpr std::uint64_t kLinkSignals = 1ULL << 33;

/// Counts a turn of the encoders on a card, by channel; 0 where there is none.
std::vector<double> link_counts(const std::vector<ActuatorConfig>& actuators, int card) {
  std::vector<double> counts;
  for (const ActuatorConfig& actuator : actuators) {
    const LinkEncoderConfig& encoder = actuator.link_encoder;
    if (encoder.card != card) continue;
    const auto channel = static_cast<std::size_t>(encoder.channel);
    if (counts.size() <= channel) counts.resize(channel + 1, 0.0);
    counts[channel] = encoder.counts_per_turn;
  }
  return counts;
}

void switch_fault(SimDevice& device, int node, FaultKind kind, double value, bool on) noexcept {
  if (kind == FaultKind::kDuplicateNode && on)  // whoever joins the bus says so
    device.outbox().send(canopen::heartbeat_frame(node, canopen::NmtState::kBootUp));
  device.outbox().set_fault(kind, value, on);
  device.set_fault(kind, value, on);
}

/// robot.yaml's actuators, mounted as sim.yaml says that they truly are.
std::vector<ActuatorConfig> mounted(const RobotConfig& robot, const SimConfig& config) {
  std::vector<ActuatorConfig> actuators = robot.actuators;
  for (std::size_t i = 0; i < actuators.size(); ++i) {
    const MountingConfig& truth = config.drives[i].mounting;
    actuators[i].direction = truth.direction.value_or(actuators[i].direction);
    LinkEncoderConfig& link = actuators[i].link_encoder;
    link.direction = truth.link_direction.value_or(link.direction);
    link.offset_rad = truth.link_offset_rad.value_or(link.offset_rad) - truth.zero_error_rad;
    actuators[i].offset_rad -= truth.zero_error_rad;
  }
  return actuators;
}

}  // namespace

Transmission::Transmission(const RobotConfig& robot) {
  const auto joints = static_cast<Eigen::Index>(robot.joints.size());
  const auto actuators = static_cast<Eigen::Index>(robot.actuators.size());
  RowMajor whole = RowMajor::Zero(joints, actuators);
  for (const LegConfig& leg : robot.legs) {
    for (std::size_t row = 0; row < leg.joints.size(); ++row) {
      for (std::size_t column = 0; column < leg.actuators.size(); ++column) {
        whole(leg.joints[row], leg.actuators[column]) = leg.transmission[row * leg.actuators.size() + column];
      }
    }
  }
  const Eigen::FullPivLU<RowMajor> factors(whole);
  if (joints != actuators || !factors.isInvertible()) {
    throw ConfigError(robot.name + ": transmission cannot be inverted, so the plant cannot be driven");
  }
  const RowMajor inverse = factors.inverse();
  for (Eigen::Index a = 0; a < actuators; ++a) {
    for (Eigen::Index j = 0; j < joints; ++j) {
      if (inverse(a, j) != 0.0)
        shares_.push_back({static_cast<std::size_t>(a), static_cast<std::size_t>(j), inverse(a, j)});
    }
  }
}

void Transmission::to_actuators(const std::vector<double>& joints,
                                std::vector<double>& actuators) const noexcept {
  std::fill(actuators.begin(), actuators.end(), 0.0);
  for (const Share& share : shares_) actuators[share.actuator] += share.of * joints[share.joint];
}

void Transmission::torques_to_joints(const std::vector<double>& actuator_Nm,
                                     std::vector<double>& joint_Nm) const noexcept {
  std::fill(joint_Nm.begin(), joint_Nm.end(), 0.0);
  for (const Share& share : shares_) joint_Nm[share.joint] += share.of * actuator_Nm[share.actuator];
}

DriveTrain::DriveTrain(const RobotConfig& robot, const SimConfig& config, std::uint64_t seed,
                       const std::vector<DriveWiring>& wiring)
    : actuators_(mounted(robot, config)),
      plant_(robot, config.plant),
      transmission_(robot),
      truths_(config.drives),
      card_truths_(config.cards),
      card_configs_(robot.encoder_cards),
      step_s_(config.plant.step_s),
      seed_(seed),
      jitter_s_(config.timing.sync_jitter_s),
      joint_rad_(robot.joints.size()),
      joint_rad_s_(robot.joints.size()),
      joint_Nm_(robot.joints.size()),
      actuator_rad_(actuators_.size()),
      actuator_rad_s_(actuators_.size()),
      actuator_Nm_(actuators_.size()),
      link_rad_(actuators_.size()),
      link_rad_s_(actuators_.size()) {
  for (std::size_t i = 0; i < actuators_.size(); ++i) {
    drives_.push_back(
        make_sim_drive({actuators_[i], config.drives[i], config.plant.step_s, seed, torque_signal(i),
                        i < wiring.size() ? wiring[i] : DriveWiring{}, config.real_windings}));
    drives_[i]->outbox().set_seed(seed, i);
  }
  for (std::size_t i = 0; i < card_configs_.size(); ++i) {
    cards_.push_back(make_sim_card({card_configs_[i], seed, link_counts(actuators_, static_cast<int>(i))}));
    cards_[i]->outbox().set_seed(seed, actuators_.size() + i);
  }
  if (config.real_windings && config.supply) supply_.emplace(*config.supply);
  step_supply();
  read_plant();
}

/// The drives have what their currents of this step leave.
void DriveTrain::step_supply() noexcept {
  if (!supply_) return;
  double drawn_W = 0.0;
  for (const auto& drive : drives_) drawn_W += drive->winding_state().power_W;
  supply_->step(drawn_W, step_s_);
  for (const auto& drive : drives_) drive->set_supply_V(supply_->voltage_V());
}

void DriveTrain::read_plant() noexcept {
  for (std::size_t j = 0; j < joint_rad_.size(); ++j) {
    joint_rad_[j] = plant_.position_rad(j);
    joint_rad_s_[j] = plant_.velocity_rad_s(j);
  }
  transmission_.to_actuators(joint_rad_, link_rad_);
  transmission_.to_actuators(joint_rad_s_, link_rad_s_);
  for (std::size_t j = 0; j < joint_rad_.size(); ++j) {
    joint_rad_[j] = plant_.motor_position_rad(j);
    joint_rad_s_[j] = plant_.motor_velocity_rad_s(j);
  }
  transmission_.to_actuators(joint_rad_, actuator_rad_);
  transmission_.to_actuators(joint_rad_s_, actuator_rad_s_);
}

double DriveTrain::shaft_rad(std::size_t actuator, double late_s) const noexcept {
  const double output_rad = actuator_rad_[actuator] + actuator_rad_s_[actuator] * late_s;
  return (output_rad - actuators_[actuator].offset_rad) * actuators_[actuator].direction;
}

/// The joint's angle and what the gear's teeth add (facts papers D7).
double DriveTrain::link_rad(std::size_t actuator, double late_s) const noexcept {
  const LinkEncoderConfig& encoder = actuators_[actuator].link_encoder;
  const KinematicErrorConfig& error = truths_[actuator].kinematic_error;
  const double output_rad = link_rad_[actuator] + link_rad_s_[actuator] * late_s;
  const double motor_rad = shaft_rad(actuator, late_s) * actuators_[actuator].gear_ratio;
  const double error_rad = error.amplitude_rad * std::sin(error.order * motor_rad + error.phase_rad);
  return (output_rad + error_rad - encoder.offset_rad) * encoder.direction;
}

void DriveTrain::open(FrameBatch* out) noexcept {
  for (auto& drive : drives_) drive->outbox().open(out);
  for (auto& card : cards_) card->outbox().open(out);
}

void DriveTrain::receive(int bus, const CanFrame& frame, std::int64_t time_us) noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (actuators_[i].bus == bus) drives_[i]->receive(frame, time_us);
  }
  for (std::size_t i = 0; i < cards_.size(); ++i) {
    if (card_configs_[i].bus == bus) cards_[i]->receive(frame, time_us);
  }
}

void DriveTrain::sample(int bus, double late_s, std::int64_t cycle) noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (actuators_[i].bus != bus) continue;
    const double jitter_s = jitter_s_ * hash_noise(seed_, jitter_signal(i), cycle);
    drives_[i]->sample(shaft_rad(i, late_s + jitter_s), cycle);
  }
  sample_links(bus, late_s, cycle);
}

void DriveTrain::sample_links(int bus, double late_s, std::int64_t cycle) noexcept {
  for (std::size_t i = 0; i < actuators_.size(); ++i) {
    const LinkEncoderConfig& encoder = actuators_[i].link_encoder;
    if (encoder.card < 0) continue;
    const auto card = static_cast<std::size_t>(encoder.card);
    if (card_configs_[card].bus != bus) continue;
    const double noise_rad = card_truths_[card].noise_rad * hash_noise(seed_, kLinkSignals + i, cycle);
    cards_[card]->sample(encoder.channel, link_rad(i, late_s) + noise_rad, cycle);
  }
}

void DriveTrain::step_drives(std::int64_t time_us) noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) drives_[i]->step(shaft_rad(i, 0.0), time_us);
  for (auto& card : cards_) card->step(time_us);
  step_supply();
}

void DriveTrain::step_plant() noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    actuator_Nm_[i] = actuators_[i].direction * drives_[i]->motor_torque_Nm();
  }
  transmission_.torques_to_joints(actuator_Nm_, joint_Nm_);
  plant_.step(joint_Nm_);
  read_plant();
}

void DriveTrain::reset_plant() noexcept {
  plant_.reset();
  read_plant();
  for (auto& drive : drives_) drive->forget_motion();
}

bool DriveTrain::all_operational() const noexcept {
  for (const auto& drive : drives_) {
    if (!drive->operational()) return false;
  }
  for (const auto& card : cards_) {
    if (!card->operational()) return false;
  }
  return true;
}

void DriveTrain::set_fault(int actuator, FaultKind kind, double value, bool on) noexcept {
  if (SimDrive* found = drive(actuator)) switch_fault(*found, actuators_[actuator].node, kind, value, on);
}

void DriveTrain::set_bus_fault(int bus, FaultKind kind, double value, bool on) noexcept {
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (actuators_[i].bus == bus) switch_fault(*drives_[i], actuators_[i].node, kind, value, on);
  }
  for (std::size_t i = 0; i < cards_.size(); ++i) {
    if (card_configs_[i].bus == bus) switch_fault(*cards_[i], card_configs_[i].node, kind, value, on);
  }
}

SimDrive* DriveTrain::drive(int actuator) noexcept {
  const bool exists = actuator >= 0 && actuator < static_cast<int>(drives_.size());
  return exists ? drives_[actuator].get() : nullptr;
}

}  // namespace sprung::sim
