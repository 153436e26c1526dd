#include "drivers/bridge/bus_load_check.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "drivers/canopen/bus_load.h"
#include "drivers/canopen/objects.h"
#include "drivers/profiles/drive_profile.h"

namespace sprung {
namespace {

constexpr int kHeartbeatBytes = 1;
constexpr int kFullFrameBytes = 8;  ///< SDO, EMCY
constexpr std::size_t kLargestShown = 3;

int frame_bits(const PdoSetting& pdo) {
  int bits = 0;
  for (const canopen::MapEntry& entry : pdo.entries) bits += entry.bits;
  return canopen::worst_frame_bits((bits + 7) / 8);
}

bool is_control_word(const PdoSetting& pdo) {
  return pdo.entries.size() == 1 && pdo.entries[0].object.index == canopen::kControlWord;
}

/// Frames a second at the worst.
double worst_rate(const PdoSetting& pdo, double cycle_s) {
  if (canopen::is_sync_type(pdo.transmission_type)) return 1.0 / (cycle_s * pdo.transmission_type);
  if (!pdo.transmit || pdo.inhibit_100us == 0) return 1.0 / cycle_s;
  return 1e6 / static_cast<double>(canopen::inhibit_us(pdo.inhibit_100us));
}

/// Comes in every cycle by plan: samples and set-points.
bool is_cyclic(const PdoSetting& pdo) {
  return pdo.transmit ? canopen::is_sync_type(pdo.transmission_type) : !is_control_word(pdo);
}

/// The bridge sends at the beginning of a cycle, rather early than late, and never twice in one
/// (BridgeCore::begin_tick).
double bridge_heartbeat_s(double heartbeat_s, double cycle_s) {
  const long long cycle_us = std::llround(1e6 * cycle_s);
  const long long cycles = std::max(1LL, std::llround(1e6 * heartbeat_s) / cycle_us);
  return 1e-6 * static_cast<double>(cycles * cycle_us);
}

class BusSum {
 public:
  BusSum(const RobotConfig& robot, const WatchdogConfig& watchdogs) : robot_(robot), watchdogs_(watchdogs) {
    for (const BusConfig& bus : robot.buses) report_.buses.push_back({bus.name, 0.0, 0.0, {}});
  }

  void add_bridge(std::size_t bus) {
    const double sync_bits = canopen::worst_frame_bits(0);
    add(bus, {"SYNC", sync_bits / robot_.cycle_s, sync_bits});
    const double heartbeat_s = bridge_heartbeat_s(watchdogs_.heartbeat_s, robot_.cycle_s);
    add(bus, {"bridge's heartbeat", canopen::worst_frame_bits(kHeartbeatBytes) / heartbeat_s, 0.0});
  }

  void add_drive(std::size_t bus, const ActuatorConfig& drive, const NodeProfile& profile) {
    add_node(bus, drive.name, drive.watch, profile);
    const double read_bits = 2.0 * canopen::worst_frame_bits(kFullFrameBytes);
    add(bus,
        {drive.name + " background reads", read_bits * (kSupplyReadsPerSecond + kModeReadsPerSecond), 0.0});
  }

  void add_node(std::size_t bus, const std::string& name, NodeWatch watch, const NodeProfile& profile) {
    for (const PdoSetting& pdo : profile.pdos()) {
      if (pdo.entries.empty()) continue;
      const double bits_per_s = frame_bits(pdo) * worst_rate(pdo, robot_.cycle_s);
      const std::string what = name + (pdo.transmit ? " TPDO" : " RPDO") + std::to_string(pdo.number + 1);
      add(bus, {what, bits_per_s, is_cyclic(pdo) ? bits_per_s * robot_.cycle_s : 0.0});
    }
    const double frame = canopen::worst_frame_bits(kFullFrameBytes);
    add_watch(bus, name, watch);
    add(bus, {name + " emergencies", frame * kEmergenciesPerSecond, 0.0});
  }

  /// A remote frame carries no data, whatever length it asks for.
  void add_watch(std::size_t bus, const std::string& name, NodeWatch watch) {
    const double answer_bits = canopen::worst_frame_bits(kHeartbeatBytes);
    if (watch == NodeWatch::kHeartbeat)
      return add(bus, {name + " heartbeat", answer_bits / watchdogs_.heartbeat_s, 0.0});
    const double period_s = bridge_heartbeat_s(watchdogs_.heartbeat_s, robot_.cycle_s);
    add(bus, {name + " guarding", (canopen::worst_frame_bits(0) + answer_bits) / period_s, 0.0});
  }

  BusLoadReport finish() {
    for (BusLoad& bus : report_.buses) {
      double bits_per_s = 0.0;
      for (const BusContribution& part : bus.contributions) {
        bits_per_s += part.bits_per_s;
        bus.cyclic_bits += part.cyclic_bits;
      }
      bus.share = canopen::load(bits_per_s, robot_.bit_rate_bit_s);
      std::stable_sort(
          bus.contributions.begin(), bus.contributions.end(),
          [](const BusContribution& a, const BusContribution& b) { return a.bits_per_s > b.bits_per_s; });
    }
    return std::move(report_);
  }

 private:
  void add(std::size_t bus, BusContribution part) {
    report_.buses.at(bus).contributions.push_back(std::move(part));
  }

  const RobotConfig& robot_;
  const WatchdogConfig& watchdogs_;
  BusLoadReport report_;
};

std::string percent(double share, const char* format = "%.1f %%") {
  char text[32];
  std::snprintf(text, sizeof text, format, 100.0 * share);
  return text;
}

}  // namespace

BusLoadReport bus_load(const RobotConfig& robot, const WatchdogConfig& watchdogs) {
  const DriveTiming timing = timing_of(robot.cycle_s, watchdogs);
  BusSum sum(robot, watchdogs);
  for (std::size_t bus = 0; bus < robot.buses.size(); ++bus) sum.add_bridge(bus);
  for (const ActuatorConfig& a : robot.actuators)
    sum.add_drive(static_cast<std::size_t>(a.bus), a, *make_profile(a, timing));
  for (const EncoderCardConfig& card : robot.encoder_cards)
    sum.add_node(static_cast<std::size_t>(card.bus), card.name, card.watch, *make_card_profile(card, timing));
  return sum.finish();
}

std::string bus_load_text(const RobotConfig& robot, const BusLoad& load) {
  const double cyclic = canopen::load(load.cyclic_bits / robot.cycle_s, robot.bit_rate_bit_s);
  return "bus " + load.bus + ": " + percent(load.share, "%.0f %%") + " worst case, " + percent(cyclic) +
         " in every cycle";
}

void check_bus_load(const RobotConfig& robot, const BusLoadReport& report) {
  for (const BusLoad& bus : report.buses) {
    if (bus.share <= kMostBusLoad) continue;
    std::string largest;
    for (std::size_t i = 0; i < std::min(kLargestShown, bus.contributions.size()); ++i) {
      const BusContribution& part = bus.contributions[i];
      largest += (i == 0 ? "" : ", ") + part.what + " " +
                 percent(canopen::load(part.bits_per_s, robot.bit_rate_bit_s));
    }
    throw std::invalid_argument(
        bus_load_text(robot, bus) + ", over the limit of " + percent(kMostBusLoad, "%.0f %%") +
        "; largest: " + largest +
        ". Lower cycle_rate, move a node to another bus, raise bit_rate or slow the heartbeats");
  }
}

}  // namespace sprung
