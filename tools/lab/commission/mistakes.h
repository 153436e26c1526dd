#pragma once
/// Mistakes of wiring and setting that people make with a drive, drawn for `sprung experiment commission`.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/enumeration.h"
#include "tools/can/commission/simulated_bench.h"
#include "tools/lab/run/dice.h"

namespace sprung {

enum class Mistake : std::int8_t {
  kNone,
  // Another drive than believed.
  kMaker,
  kFirmware,
  kNodeId,
  kNodeTwice,
  kStandingFault,
  kStoredElsewhere,
  kPowerLost,
  // Settings of the drive.
  kMotorType,
  kPolePairs,
  kEncoderCounts,
  kEncoderType,
  kEncoderPolarity,
  kCurrentGains,
  kLimits,
  kBitRate,
  // Wiring.
  kPhases,
  kPhasesAndEncoder,
  kEncoderReversed,
  kEncoderDead,
  kCommutationAngle,
  kLinkEncoder,
  kEmergencyLevel,
  kEmergencyDead,
  // robot.yaml.
  kGearRatio,
  kDirection,
  kBelievedCounts,
  kTorqueConstant,
};
constexpr auto words_of(Mistake) {
  using E = Mistake;
  return words<E>({{E::kNone, "none"},
                   {E::kMaker, "drive of another maker"},
                   {E::kFirmware, "drive of another firmware"},
                   {E::kNodeId, "another node id"},
                   {E::kNodeTwice, "node id twice"},
                   {E::kStandingFault, "supply too low"},
                   {E::kStoredElsewhere, "configuration of another robot"},
                   {E::kPowerLost, "power lost in the middle"},
                   {E::kMotorType, "motor type"},
                   {E::kPolePairs, "pole pairs"},
                   {E::kEncoderCounts, "encoder counts in the drive"},
                   {E::kEncoderType, "encoder type"},
                   {E::kEncoderPolarity, "encoder polarity"},
                   {E::kCurrentGains, "current gains of another motor"},
                   {E::kLimits, "limits of another robot"},
                   {E::kBitRate, "bit rate"},
                   {E::kPhases, "two phases swapped"},
                   {E::kPhasesAndEncoder, "phases and encoder swapped"},
                   {E::kEncoderReversed, "encoder wired the other way"},
                   {E::kEncoderDead, "encoder cable off"},
                   {E::kCommutationAngle, "commutation angle"},
                   {E::kLinkEncoder, "link encoder the other way"},
                   {E::kEmergencyLevel, "emergency input inverted"},
                   {E::kEmergencyDead, "emergency stop not wired"},
                   {E::kGearRatio, "gear ratio in robot.yaml"},
                   {E::kDirection, "direction in robot.yaml"},
                   {E::kBelievedCounts, "encoder counts in robot.yaml"},
                   {E::kTorqueConstant, "torque constant in robot.yaml"}});
}

/// One drive of a bench: what is believed, what is true, and what is done to it on the way.
struct CommissionCase {
  Mistake mistake = Mistake::kNone;
  std::string detail{};  ///< for people: "12 pole pairs, the drive believes 14"
  RobotConfig believed{};
  RobotConfig machine{};
  int actuator = 0;
  commission::BenchSetup setup{};
  std::function<void(commission::SimulatedBench&)> prepare{};  ///< before the walk begins; may be empty
};

/// Whether this make, wired like this, can have it: a Gold's gains and pole pairs are mistakes too, but it
/// has no object that says them.
bool possible(Mistake mistake, const ActuatorConfig& actuator);

/// @param mistake kNone: a right drive with a drawn plant. @throws std::invalid_argument where it is not
/// possible on any drive of this robot.
CommissionCase draw_case(const RobotConfig& robot, Mistake mistake, std::uint64_t seed, Dice& dice);

}  // namespace sprung
