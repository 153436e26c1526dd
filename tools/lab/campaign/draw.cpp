#include "tools/lab/campaign/draw.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "tools/lab/campaign/link_tamper.h"
#include "tools/lab/faults/fault_motion.h"
#include "tools/lab/run/dice.h"

namespace sprung::campaign {
namespace {

constexpr double kLongestWait_s = 0.6;
constexpr double kFrictionSpread = 0.20, kMassSpread = 0.10;  // as `sprung experiment endurance`
constexpr double kSlippery = 0.4, kGrippy = 1.0;
constexpr std::size_t kOneInSoManyHasTwo = 3;

constexpr std::array kDriveFaults{
    FaultKind::kOverCurrent,      FaultKind::kUnderVoltage,  FaultKind::kOverTemperature,
    FaultKind::kEncoderStuck,     FaultKind::kEncoderJump,   FaultKind::kEncoderNoise,
    FaultKind::kCurrentOffset,    FaultKind::kFramesLost,    FaultKind::kFramesLate,
    FaultKind::kFramesDuplicated, FaultKind::kFramesFlipped, FaultKind::kHeartbeatStopped,
    FaultKind::kPowerCycle,       FaultKind::kDuplicateNode, FaultKind::kShortPdo};
constexpr std::array kBusFaults{FaultKind::kBusOff, FaultKind::kErrorPassive, FaultKind::kLinkDown,
                                FaultKind::kQueueFull};
/// Drives and what they say have the most kinds of fault: two shares.
constexpr std::array kClasses{Class::kDrive, Class::kDrive,   Class::kBus,     Class::kMessage,
                              Class::kField, Class::kProcess, Class::kForeign, Class::kFile};

/// Sizes from what hardly shows to what nothing survives; 0 where the fault has none.
double size_of(FaultKind kind, double cycle_s, Dice& dice) {
  switch (kind) {
    case FaultKind::kEncoderJump:
      return dice.either_sign(dice.scale(0.02, 1.0));
    case FaultKind::kEncoderNoise:
      return dice.scale(1e-4, 0.3);
    case FaultKind::kCurrentOffset:
      return dice.between(-2.0, 2.0);
    case FaultKind::kFramesLost:
    case FaultKind::kFramesDuplicated:
    case FaultKind::kFramesFlipped:
      return dice.scale(0.02, 1.0);
    case FaultKind::kFramesLate:
      return cycle_s * dice.scale(0.2, 4.0);
    default:
      return 0.0;
  }
}

template <class E>
E any_of_kind(Dice& dice) {
  return kWords<E>[dice.below(kWords<E>.size())].value;
}

/// IMU is the last of them.
Link any_link(bool has_imu, Dice& dice) {
  return kWords<Link>[dice.below(kWords<Link>.size() - (has_imu ? 0 : 1))].value;
}

void draw_message(Injection& out, bool has_imu, Dice& dice) {
  out.link = any_link(has_imu, dice);
  out.link_fault = any_of_kind<LinkFault>(dice);
  switch (out.link_fault) {
    case LinkFault::kLost:
    case LinkFault::kFlipped:
      out.value = dice.scale(0.02, 1.0);
      break;
    case LinkFault::kLate:
      out.value = std::floor(dice.scale(1.0, 60.0));
      break;
    case LinkFault::kFuture:
      out.value = std::floor(dice.scale(1.0, 1e6));
      break;
    case LinkFault::kRepeated:
    case LinkFault::kDisorder:
      break;
  }
}

void draw_field(Injection& out, bool has_imu, Dice& dice) {
  out.link = any_link(has_imu, dice);
  out.field_fault = any_of_kind<FieldFault>(dice);
  out.field = static_cast<int>(dice.below(static_cast<std::size_t>(fields_of(out.link))));
}

void draw_process(Injection& out, Dice& dice) {
  out.process = static_cast<StackProcess>(dice.below(4));
  out.process_fault = any_of_kind<ProcessFault>(dice);
  if (out.process_fault == ProcessFault::kKilled) out.duration_s = 0.0;
  if (out.process_fault == ProcessFault::kStopped) out.duration_s = dice.scale(0.005, 0.5);
  if (out.process_fault == ProcessFault::kBusy) out.value = static_cast<double>(2 + dice.below(4));
}

bool has_mate(const RobotConfig& robot, int actuator) {
  const auto& all = robot.actuators;
  return std::count_if(all.begin(), all.end(),
                       [&](const ActuatorConfig& one) { return one.bus == all[actuator].bus; }) > 1;
}

void draw_mistake(Injection& out, const RobotConfig& robot, Dice& dice) {
  out.mistake = any_of_kind<FileMistake>(dice);
  // There is nothing to swap with.
  if (out.mistake == FileMistake::kSwapped && !has_mate(robot, out.target)) out.mistake = FileMistake::kSign;
  out.duration_s = 0.0;
  if (out.mistake == FileMistake::kZero) out.value = dice.either_sign(dice.between(0.1, 0.6));
  if (out.mistake == FileMistake::kRatio) out.value = dice.one_in(2) ? 0.5 : 2.0;
}

Injection draw_injection(const RobotConfig& robot, Class kind, Dice& dice) {
  Injection out;
  out.kind = kind;
  out.duration_s = dice.scale(0.01, 1.0);
  out.target = static_cast<int>(dice.below(robot.actuators.size()));
  const bool has_imu = robot.body.mass_kg > 0.0;
  switch (kind) {
    case Class::kNone:
      break;
    case Class::kDrive:
      out.drive_fault = dice.one_of(kDriveFaults);
      out.value = size_of(out.drive_fault, robot.cycle_s, dice);
      break;
    case Class::kBus:
      out.drive_fault = dice.one_of(kBusFaults);
      out.target = static_cast<int>(dice.below(robot.buses.size()));
      out.half_of_buses = robot.buses.size() > 1 && dice.one_in(3);
      break;
    case Class::kMessage:
      draw_message(out, has_imu, dice);
      break;
    case Class::kField:
      draw_field(out, has_imu, dice);
      break;
    case Class::kProcess:
      draw_process(out, dice);
      break;
    case Class::kForeign:
      out.foreign = any_of_kind<Foreign>(dice);
      if (out.foreign == Foreign::kSetpoint) out.value = dice.between(-1.0, 1.0);
      if (dice.one_in(2)) out.duration_s = robot.cycle_s;  // one frame
      break;
    case Class::kFile:
      draw_mistake(out, robot, dice);
      break;
  }
  return out;
}

SimOptions draw_plant(const RobotConfig& robot, Dice& dice) {
  SimOptions sim;
  sim.plant["friction_scale"] = dice.between(1.0 - kFrictionSpread, 1.0 + kFrictionSpread);
  sim.plant["mass_scale"] = dice.between(1.0 - kMassSpread, 1.0 + kMassSpread);
  if (robot.body.mass_kg > 0.0) sim.plant["ground_friction"] = dice.between(kSlippery, kGrippy);
  return sim;
}

}  // namespace

std::vector<std::string> states_of(const RobotConfig& robot) {
  std::vector<std::string> out = fault_motions(robot);
  if (robot.has_feet()) out.insert(out.end(), {"rising", "sitting"});
  out.emplace_back("clearing");
  const auto homes = [](const ActuatorConfig& a) { return a.reference.method != ReferenceMethod::kNone; };
  if (std::any_of(robot.actuators.begin(), robot.actuators.end(), homes)) out.emplace_back("homing");
  return out;
}

Draw draw_run(const RobotConfig& robot, std::uint64_t seed, std::uint64_t number, Class only) {
  std::seed_seq mixed{seed, seed >> 32, number, number >> 32};
  std::array<std::uint32_t, 2> words{};
  mixed.generate(words.begin(), words.end());
  Dice dice((std::uint64_t{words[1]} << 32) | words[0]);
  Draw out;
  out.seed = seed;
  out.number = number;
  out.only = only;
  const std::vector<std::string> states = states_of(robot);
  out.state = dice.one_of(states);
  out.wait_s = dice.between(0.0, kLongestWait_s);
  out.sim = draw_plant(robot, dice);
  out.sim.seed = (std::uint64_t{words[0]} << 32) ^ words[1];
  const auto kind = [&] { return only == Class::kNone ? dice.one_of(kClasses) : only; };
  out.injections.push_back(draw_injection(robot, kind(), dice));
  out.injections[0].at_seq = 0;
  if (out.injections[0].kind == Class::kFile || !dice.one_in(kOneInSoManyHasTwo)) return out;
  Class second = kind();
  if (second == Class::kFile) second = Class::kDrive;  // a file is wrong from the beginning
  out.injections.push_back(draw_injection(robot, second, dice));
  out.second_while_clearing = dice.one_in(2);
  out.injections[1].at_seq = std::lround(dice.between(0.0, 0.5) / robot.cycle_s);
  return out;
}

}  // namespace sprung::campaign
