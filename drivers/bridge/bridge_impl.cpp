#include "drivers/bridge/bridge_impl.h"

#include <algorithm>
#include <stdexcept>

#include "robots/maintenance.h"

namespace sprung {
namespace {

constexpr double kSlow_rad_s = 0.1;  // [design choice] nearly at rest

std::vector<DriveNode*> pointers(const std::vector<std::unique_ptr<DriveNode>>& drives) {
  std::vector<DriveNode*> found;
  found.reserve(drives.size());
  for (const auto& drive : drives) found.push_back(drive.get());
  return found;
}

/// Of motor and gear, as the actuator's joint knows it; 0: no leg has it.
double inertia_kg_m2(const RobotConfig& robot, int actuator) {
  const int joint = robot.joint_of_actuator(actuator);
  return joint < 0 ? 0.0 : robot.joints[static_cast<std::size_t>(joint)].armature_kg_m2;
}

DrivePlant plant_of(const RobotConfig& robot, int actuator) {
  const ActuatorConfig built = as_built(robot, actuator);
  return {inertia_kg_m2(robot, actuator), drive_range(robot, actuator), built.torque_limit_Nm,
          built.speed_limit_rad_s};
}

}  // namespace

BridgeCore::Impl::Impl(const RobotConfig& config, const BridgeOptions& bridge_options)
    : robot(config),
      watchdogs(bridge_options.watchdogs),
      cycle_us(to_us(config.cycle_s)),
      by_bus_and_node(config.buses.size()),
      battery(config.battery),
      auxiliary(config.actuators.size()),
      buses(robot, bridge_options.watchdogs),
      masters(robot),
      gate(config),
      setpoints(config),
      limits(config),
      safety(bridge_options.watchdogs, config.lowering_s),
      state(config.actuators.size()),
      motion(config.actuators.size()),
      set_points(config.actuators.size()),
      bus_state(config.buses.size(), config.actuators.size() + config.encoder_cards.size()) {
  for (const ActuatorConfig& actuator : robot.actuators) {
    drives.push_back(std::make_unique<DriveNode>(actuator, static_cast<int>(drives.size()), robot.cycle_s,
                                                 watchdogs,
                                                 plant_of(robot, static_cast<int>(drives.size()))));
    add(*drives.back());
  }
  for (const EncoderCardConfig& card : robot.encoder_cards) {
    cards.push_back(std::make_unique<EncoderCardNode>(card, robot.cycle_s, watchdogs));
    add(*cards.back());
  }
  check_card_channels();
  recovery = std::make_unique<Recovery>(nodes);
  homing = std::make_unique<Homing>(pointers(drives));
  last_clear.reply.request_id = last_home.reply.request_id = -1;
}

void BridgeCore::Impl::add(BusNode& added) {
  const int bus = added.link().setup().bus;
  const int node = added.link().setup().node;
  const bool exists = bus >= 0 && static_cast<std::size_t>(bus) < robot.buses.size() && node > 0 &&
                      node < canopen::kBridgeNode;
  if (!exists) throw std::invalid_argument("'" + added.name() + "': no such bus or node");
  BusNode*& place = by_bus_and_node[bus][node];
  if (place != nullptr)
    throw std::invalid_argument("'" + added.name() + "' and '" + place->name() + "' have one node id");
  place = &added;
  nodes.push_back(&added);
}

/// The loader knows no profiles: it lets pass what any card may have.
void BridgeCore::Impl::check_card_channels() const {
  for (const ActuatorConfig& actuator : robot.actuators) {
    const LinkEncoderConfig& encoder = actuator.link_encoder;
    if (encoder.card < 0) continue;
    const EncoderCardNode& card = *cards.at(encoder.card);
    if (encoder.channel >= 0 && encoder.channel < card.channels()) continue;
    throw std::invalid_argument("actuator '" + actuator.name + "': encoder card '" + card.name() +
                                "' has no channel " + std::to_string(encoder.channel) + "; it has " +
                                std::to_string(card.channels()) + ", counted from 0");
  }
}

void BridgeCore::Impl::push_on_every_bus(const CanFrame& frame, FrameBatch& out) const noexcept {
  for (std::size_t bus = 0; bus < robot.buses.size(); ++bus) out.push(static_cast<int>(bus), frame);
}

/// Rather early than late for the drives' consumers. A drive that obeys no stop gets none (stop_watch.h).
void BridgeCore::Impl::push_heartbeats(std::int64_t time_us, FrameBatch& out) noexcept {
  if (time_us + cycle_us <= next_heartbeat_us) return;
  next_heartbeat_us = time_us + to_us(watchdogs.heartbeat_s);
  const CanFrame heartbeat = canopen::heartbeat_frame(canopen::kBridgeNode, canopen::NmtState::kOperational);
  for (std::size_t bus = 0; bus < robot.buses.size(); ++bus) {
    const bool withheld = std::any_of(drives.begin(), drives.end(), [bus](const auto& drive) {
      return drive->stop().step() == StopStep::kWithhold &&
             static_cast<std::size_t>(drive->actuator().bus) == bus;
    });
    if (!withheld) out.push(static_cast<int>(bus), heartbeat);
  }
}

bool BridgeCore::Impl::at_rest() const noexcept {
  return cyclic && safety.level() != SafetyLevel::kDamping &&
         all_drives([](const DriveNode& n) { return !n.powered(); });
}

void BridgeCore::Impl::begin_restore() noexcept {
  for (auto& drive : drives) drive->begin_restore();
}

/// A drive that obeys no stop is not asked either: its life time runs out.
void BridgeCore::Impl::push_guarding(std::int64_t time_us, FrameBatch& out) noexcept {
  for (auto& drive : drives)
    if (drive->stop().step() != StopStep::kWithhold) drive->link().guard(time_us, cycle_us, out);
  for (auto& card : cards) card->link().guard(time_us, cycle_us, out);
}

void BridgeCore::Impl::show_stops(DetailText& detail) const noexcept {
  for (const auto& drive : drives) {
    const StopWatch& stop = drive->stop();
    if (stop.worst() < StopStep::kSdo) continue;
    const bool works = stop.step() == StopStep::kNone;
    append(detail, "; %s: %s %s", drive->name().c_str(), works ? "was stopped" : "is being stopped",
           text(stop.worst()));
    return;
  }
}

void BridgeCore::Impl::count_sent(const FrameBatch& batch, int first) noexcept {
  for (int i = first; i < batch.size(); ++i) buses.sent(batch[i].bus, batch[i].frame);
}

/// NMT start goes out when every node is configured; one that boots again in operation finds the others
/// started.
void BridgeCore::Impl::step_boot(std::int64_t time_us) noexcept {
  refuse_nodes(time_us);
  if (!cyclic) restart_lost_nodes(time_us);
  const bool ready = cyclic || all_links([](const NodeLink& link) {
                       return link.boot().configured() || link.boot().started();
                     });
  if (!ready) return;
  for (BusNode* node : nodes) node->link().start();
}

/// One that has left operational while the others still boot: before the first cycle nobody is asked. Of two
/// devices on one id none can be brought back; they become trouble in the first cycle.
void BridgeCore::Impl::restart_lost_nodes(std::int64_t time_us) noexcept {
  for (BusNode* node : nodes) {
    const NodeLink& link = node->link();
    const bool gone = link.lost(time_us) || link.silent();
    if (link.boot().operational() && gone && !link.duplicate()) node->restart();
  }
}

void BridgeCore::Impl::refuse_nodes(std::int64_t time_us) noexcept {
  for (const BusNode* node : nodes) {
    const NodeBoot& boot = node->link().boot();
    if (boot.refused()) {
      safety.refuse_drive({SafetyCause::kDriveRefused, node->link().setup().actuator, boot.detail()}, time_us,
                          cycle);
      return;  // one at a time: the detail has room for one
    }
  }
}

void BridgeCore::Impl::judge_samples() noexcept {
  for (BusNode* node : nodes) node->end_sampling();
  for (auto& drive : drives) {
    const LinkEncoderConfig& encoder = drive->actuator().link_encoder;
    if (encoder.card < 0) continue;
    drive->set_link_position(cards[encoder.card]->measured_link_position_rad(encoder));
  }
  judge_motion();
}

/// The last two drives of a leg, hip and knee, which swing in one plane: what one does moves the other, while
/// an abduction joint before them may rest.
void BridgeCore::Impl::judge_motion() noexcept {
  for (const LegConfig& leg : robot.legs) {
    if (leg.actuators.size() < 2) continue;
    DriveNode& hip = *drives[leg.actuators[leg.actuators.size() - 2]];
    DriveNode& knee = *drives[leg.actuators.back()];
    const double hip_rad = hip.encoder_position_rad(), knee_rad = knee.encoder_position_rad();
    hip.judge_motion(knee_rad);
    knee.judge_motion(hip_rad);
  }
  for (std::size_t i = 0; i < drives.size(); ++i) drives[i]->show(motion[i]);
  limits.judge(motion, sync_us);
}

void BridgeCore::Impl::emit(std::int64_t time_us, FrameBatch& out) noexcept {
  const SafetyLevel level = safety.level();
  std::copy(gate.last().actuators.begin(), gate.last().actuators.end(), set_points.begin());
  if (obeys(level)) {
    setpoints.limit(motion, set_points);
  } else {
    setpoints.forget();
  }
  for (std::size_t i = 0; i < drives.size(); ++i) {
    if (buses.sending_failed(drives[i]->actuator().bus)) drives[i]->resend_control_word();
    drives[i]->emit(time_us, level, set_points[i], out);
  }
}

/// Drives often come up with a fault (facts canopen 2.5), so cyclic operation begins with resetting them.
void BridgeCore::Impl::begin_cycle(std::int64_t time_us) noexcept {
  if (!cyclic) {
    recovery->begin(Recovery::Kind::kFirstCycle, time_us);
    if (!buses.any_lost()) {  // what booting has got over is no trouble
      buses.forget_trouble();
      buses.forget_losses();
    }
  }
  cyclic = true;
  ++cycle;
}

/// Before this cycle's command is due, that of the cycle before counts as new.
double BridgeCore::Impl::command_age_s(std::int64_t time_us, bool command_due) const noexcept {
  if (!gate.any()) return 0.0;
  const std::int64_t age_us = command_due ? time_us - good_sync_us : sync_us - good_sync_us - cycle_us;
  return 1e-6 * static_cast<double>(std::max<std::int64_t>(age_us, 0));
}

bool BridgeCore::Impl::find_fault(std::int64_t time_us, Fault& out) const noexcept {
  for (const BusNode* node : nodes) {
    out.actuator = node->link().setup().actuator;
    if (node->fault(time_us, recovery->running(), out)) return true;
  }
  return limits.fault(out);
}

/// The leg controller lets the robot down by itself where LEG_COMMAND is stale, and says in each
/// DRIVE_COMMAND which one it has used. One that comes back in time is a stall; later it must not make the
/// robot move again unasked.
bool BridgeCore::Impl::planner_lost(Fault& out) const noexcept {
  const DriveCommand& last = gate.last();
  const bool planned = gate.any() && last.used_leg_command_seq >= 0;
  if (!planned || all_drives([](const DriveNode& drive) { return !drive.powered(); })) return false;
  const std::int64_t age_us = (last.stamp.seq - last.used_leg_command_seq) * cycle_us;
  if (age_us <= to_us(watchdogs.command_stop_s)) return false;
  out.cause = SafetyCause::kPlannerLost;
  out.actuator = -1;
  print(out.detail, "the last LEG_COMMAND is %lld ms old: is sprung-motion-planner dead?",
        static_cast<long long>(age_us / 1000));
  return true;
}

void BridgeCore::Impl::emergency_stop(std::int64_t time_us, const Fault* fault) noexcept {
  safety.emergency_stop(time_us, cycle, fault);
  gate.disarm();
  recovery->abort("emergency stop");
}

const DriveNode* BridgeCore::Impl::stopping_input() const noexcept {
  for (const auto& drive : drives)
    if (drive->emergency_input().stops()) return drive.get();
  return nullptr;
}

void BridgeCore::Impl::heed_emergency_inputs(std::int64_t time_us) noexcept {
  const DriveNode* drive = stopping_input();
  const bool known = safety.latched() && safety.cause() == SafetyCause::kEmergencyStop;
  if (drive == nullptr || known) return;
  Fault fault;
  fault.cause = SafetyCause::kEmergencyStop;
  fault.actuator = drive->link().setup().actuator;
  print(fault.detail, "emergency stop by the input of %s", drive->name().c_str());
  emergency_stop(time_us, &fault);
}

void BridgeCore::Impl::update_safety(std::int64_t time_us, bool command_due) noexcept {
  heed_emergency_inputs(time_us);
  SafetyInputs inputs;
  inputs.time_us = time_us;
  inputs.cycle = cycle;
  inputs.armed = gate.armed() && !recovery->running() &&
                 all_drives([](const DriveNode& drive) { return drive.emergency_input().known(); });
  inputs.command_age_s = command_age_s(time_us, command_due);
  inputs.command_expired = command_due && gate.any() && time_us > gate.last().valid_until_utime_us;
  inputs.command_refused = gate.last_was_refused();
  inputs.refusal = &gate.detail();
  const Fault* foreign = masters.fault();
  const bool latched = safety.latched();
  if (!latched && planner_lost(planner_trouble)) inputs.planner = &planner_trouble;
  if (!latched || safety.level() == SafetyLevel::kLowering || safety.unexplained())
    inputs.drive = foreign != nullptr ? foreign : find_fault(time_us, node_trouble) ? &node_trouble : nullptr;
  inputs.bus = buses.fault() == nullptr && masters.insists() ? foreign : buses.fault();
  inputs.overruns_in_row = overruns_in_row;
  inputs.slow = all_drives(
      [](const DriveNode& n) { return std::abs(n.filtered_velocity_rad_s()) < kSlow_rad_s; });
  safety.update(inputs);
  for (BusNode* node : nodes) node->link().faults_seen();
  buses.forget_trouble();
  if (safety.latched()) gate.disarm();
}

}  // namespace sprung
