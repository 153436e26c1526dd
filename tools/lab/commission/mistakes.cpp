#include "tools/lab/commission/mistakes.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "drivers/canopen/objects.h"
#include "signals/angles.h"
#include "tools/can/commission/walk.h"
#include "tools/can/commission/wired_drives.h"

namespace sprung {
namespace {

using commission::SimulatedBench;
using sim::DriveWiring;

constexpr int kEmergencyBit = 3;

ActuatorConfig& actuator(RobotConfig& robot, int index) {
  return robot.actuators[static_cast<std::size_t>(index)];
}

void store(DriveWiring& wiring, canopen::ObjectId object, std::int64_t value) {
  for (auto& [id, stored] : wiring.stored) {
    if (id.index == object.index && id.sub == object.sub) {
      stored = value;
      return;
    }
  }
  wiring.stored.emplace_back(object, value);
}

std::string said(const char* format, double a, double b) {
  char text[120];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

bool is_epos2(const ActuatorConfig& drive) { return drive.profile == "epos2"; }

void of_the_drive(CommissionCase& c, DriveWiring& wiring, Dice& dice) {
  ActuatorConfig& drive = actuator(c.machine, c.actuator);
  switch (c.mistake) {
    case Mistake::kMaker:
      drive.profile = is_epos2(drive) ? "gold" : "epos2";
      drive.speed_limit_object = drive.position_gains_object = drive.position_limits_object = 0;
      drive.torque_limit_Nm = std::min(drive.torque_limit_Nm, 40.0);
      drive.rated_current_A = std::min(drive.rated_current_A, 5.0);
      drive.identity = {};
      wiring = commission::commissioned_drive(drive);
      c.detail = "a " + drive.profile;
      return;
    case Mistake::kFirmware:
      if (is_epos2(drive)) {
        store(wiring, {canopen::kIdentity, 3}, 0x21100000);
      } else {
        store(wiring, {canopen::kIdentity, 2}, 0x00030924);
      }
      c.detail = is_epos2(drive) ? "revision 0x21100000" : "product 0x00030924";
      return;
    case Mistake::kNodeId:
      drive.node = dice.one_in(2) ? 127 : drive.node + 20;
      c.detail = "id " + std::to_string(drive.node);
      for (auto& [id, value] : wiring.stored)
        if (id.index == 0x2000) value = drive.node;
      return;
    case Mistake::kNodeTwice:
      c.prepare = [](SimulatedBench& bench) { bench.fault(FaultKind::kDuplicateNode, 1.0, 0.0); };
      return;
    case Mistake::kStandingFault:
      c.prepare = [](SimulatedBench& bench) {
        bench.fault(FaultKind::kUnderVoltage, 5.0, 0.0);
        bench.wait(0.05);
      };
      return;
    case Mistake::kPowerLost: {
      const std::string at = dice.one_of(std::vector<std::string>{"stored configuration", "limits",
                                                                  "turned by hand", "power", "current step",
                                                                  "commutation and signs"});
      const int transfer = 1 + static_cast<int>(dice.below(at == "commutation and signs" ? 200 : 2));
      const double seconds = dice.one_in(2) ? 0.15 : 30.0;
      c.detail = "in step " + at + said(", transfer %.0f, for %.2f s", transfer, seconds);
      c.prepare = [=](SimulatedBench& bench) {
        bench.break_at(at, transfer,
                       [=](SimulatedBench& broken) { broken.fault(FaultKind::kPowerCycle, 0.0, seconds); });
      };
      return;
    }
    default:
      return;
  }
}

void of_settings(CommissionCase& c, DriveWiring& wiring, Dice& dice) {
  const bool readable = is_epos2(actuator(c.machine, c.actuator));
  switch (c.mistake) {
    case Mistake::kMotorType:
      return store(wiring, {0x6402, 0}, 1);
    case Mistake::kPolePairs: {
      // Not one that robot.yaml knows: the motion has to show it.
      if (dice.one_in(2)) actuator(c.believed, c.actuator).pole_pairs = 0;
      const int pairs = wiring.pole_pairs + (dice.one_in(2) ? -1 : 1) * (1 + static_cast<int>(dice.below(4)));
      readable ? store(wiring, {0x6410, 3}, pairs) : void(wiring.drive_pole_pairs = pairs);
      c.detail = said("%.0f, the drive believes %.0f", wiring.pole_pairs, pairs) +
                 (actuator(c.believed, c.actuator).pole_pairs == 0 ? ", robot.yaml does not know" : "");
      return;
    }
    case Mistake::kEncoderCounts:
      return store(wiring, {0x2210, 1}, dice.one_of(std::vector<int>{500, 1000, 2048, 8192}));
    case Mistake::kEncoderType:
      return store(wiring, {0x2210, 2}, dice.one_of(std::vector<int>{3, 4, 5}));
    case Mistake::kEncoderPolarity:
      return store(wiring, {0x2210, 4}, 1);
    case Mistake::kCurrentGains: {
      const bool high = dice.one_in(2);
      // High enough to swing up (motor_wiring.h), at the loops of sim.yaml: 146 Hz of the EPOS2s, 94 Hz of
      // the Golds.
      const double lowest = readable ? 14.0 : 21.0;
      const double share = high ? dice.between(lowest, 1.5 * lowest) : dice.between(0.05, 0.2);
      if (readable) {
        store(wiring, {0x60F6, 1}, static_cast<std::int64_t>(wiring.fitting_p * share));
        store(wiring, {0x60F6, 2}, static_cast<std::int64_t>(wiring.fitting_i * share));
      } else {
        wiring.gain_p = wiring.gain_i = share;
      }
      c.detail = said("%.2f times the fitting ones", share, 0);
      return;
    }
    case Mistake::kLimits: {
      const double share = dice.one_in(2) ? dice.between(0.3, 0.8) : dice.between(1.3, 2.0);
      for (auto& [id, value] : wiring.stored)
        if (id.index == 0x6410 || id.index == 0x6075 || id.index == 0x6072)
          if (id.sub != 3) value = static_cast<std::int64_t>(static_cast<double>(value) * share);
      c.detail = said("%.2f times", share, 0);
      return;
    }
    case Mistake::kBitRate:
      return store(wiring, {0x2001, 0}, 2);
    case Mistake::kStoredElsewhere:
      store(wiring, {0x6007, 0}, 0);
      store(wiring, {0x605C, 0}, 1);
      store(wiring, {0x605B, 0}, 1);
      store(wiring, {0x60FB, 1}, 977);
      store(wiring, {0x6065, 0}, 41234);
      return;
    default:
      return;
  }
}

void of_wiring(CommissionCase& c, DriveWiring& wiring, Dice& dice) {
  ActuatorConfig& drive = actuator(c.machine, c.actuator);
  switch (c.mistake) {
    case Mistake::kPhases:
      wiring.phases_swapped = true;
      return;
    case Mistake::kPhasesAndEncoder:
      wiring.phases_swapped = wiring.encoder_reversed = true;
      return;
    case Mistake::kEncoderReversed:
      wiring.encoder_reversed = true;
      return;
    case Mistake::kEncoderDead:
      wiring.encoder_dead = true;
      return;
    case Mistake::kCommutationAngle:
      wiring.commutation_error_rad = dice.either_sign(dice.between(0.7, kPi));
      c.detail = said("%.0f electrical degrees off", wiring.commutation_error_rad * 180.0 / kPi, 0);
      return;
    case Mistake::kLinkEncoder:
      actuator(c.believed, c.actuator).link_encoder.direction *= -1.0;
      return;
    case Mistake::kEmergencyLevel:
      drive.emergency_input.stops_high = !drive.emergency_input.stops_high;
      return;
    case Mistake::kEmergencyDead:
      wiring.emergency_dead = true;
      return;
    default:
      return;
  }
}

void of_the_file(CommissionCase& c, Dice& dice) {
  ActuatorConfig& believed = actuator(c.believed, c.actuator);
  switch (c.mistake) {
    case Mistake::kGearRatio: {
      const double share = dice.one_of(std::vector<double>{0.5, 0.8, 1.2, 1.6, 2.0});
      believed.gear_ratio *= share;
      believed.torque_limit_Nm *= std::min(1.0, share);  // else the profile refuses the file at once
      c.detail = said("%.0f, true %.0f", believed.gear_ratio, actuator(c.machine, c.actuator).gear_ratio);
      return;
    }
    case Mistake::kDirection:
      believed.direction *= -1.0;
      return;
    case Mistake::kBelievedCounts:  // and the drive was told the same
      believed.encoder_counts_per_turn *= dice.one_of(std::vector<double>{0.25, 0.5, 2.0});
      c.setup.sim.wiring[static_cast<std::size_t>(c.actuator)]
          .encoder_counts_per_turn = actuator(c.machine, c.actuator).encoder_counts_per_turn;
      store(c.setup.sim.wiring[static_cast<std::size_t>(c.actuator)], {0x2210, 1},
            static_cast<std::int64_t>(believed.encoder_counts_per_turn / 4.0));
      c.detail = said("%.0f, true %.0f", believed.encoder_counts_per_turn,
                      actuator(c.machine, c.actuator).encoder_counts_per_turn);
      return;
    case Mistake::kTorqueConstant:
      c.setup.sim.plant["kt_scale"] = dice.one_in(2) ? dice.between(0.75, 0.84) : dice.between(1.2, 1.35);
      c.detail = said("true one is %.2f times", c.setup.sim.plant["kt_scale"], 0);
      return;
    default:
      return;
  }
}

/// Within what robot.yaml says of itself: 3 % of torque constant, and friction that a warm day changes.
void draw_plant(CommissionCase& c, Dice& dice) {
  c.setup.sim.plant["friction_scale"] = dice.between(0.85, 1.15);
  c.setup.sim.plant["kt_scale"] = dice.between(0.97, 1.03);
  c.setup.sim.plant["noise_scale"] = dice.between(0.5, 1.5);
  c.setup.angle_error = dice.between(-0.05, 0.05);
  c.setup.sling = dice.between(0.7, 1.1);
}

}  // namespace

bool possible(Mistake mistake, const ActuatorConfig& actuator) {
  switch (mistake) {
    case Mistake::kMotorType:
    case Mistake::kEncoderCounts:
    case Mistake::kEncoderType:
    case Mistake::kEncoderPolarity:
    case Mistake::kBitRate:
      return is_epos2(actuator);
    case Mistake::kLinkEncoder:
      return actuator.link_encoder.card >= 0;
    default:
      return true;
  }
}

CommissionCase draw_case(const RobotConfig& robot, Mistake mistake, std::uint64_t seed, Dice& dice) {
  CommissionCase c;
  c.mistake = mistake;
  c.believed = robot;
  for (ActuatorConfig& one : c.believed.actuators) one.emergency_input = {kEmergencyBit, false};
  c.machine = c.believed;
  c.actuator = static_cast<int>(dice.below(robot.actuators.size()));
  const ActuatorConfig& drive = c.machine.actuators[static_cast<std::size_t>(c.actuator)];
  if (!possible(mistake, drive))
    throw std::invalid_argument(drive.profile + " cannot have: " + name(mistake));
  c.setup.bus = drive.bus;
  c.setup.actuator = c.actuator;
  c.setup.joint = robot.joint_of_actuator(c.actuator);
  c.setup.sim.seed = seed;
  c.setup.sim.wiring = std::vector<DriveWiring>(robot.actuators.size());
  DriveWiring& wiring = c.setup.sim.wiring[static_cast<std::size_t>(c.actuator)];
  wiring = commission::commissioned_drive(drive);
  draw_plant(c, dice);
  of_the_drive(c, wiring, dice);
  of_settings(c, wiring, dice);
  of_wiring(c, wiring, dice);
  of_the_file(c, dice);
  return c;
}

}  // namespace sprung
