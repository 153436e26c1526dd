#pragma once
/// One thing that goes wrong in a campaign, as drawn: which, where, how large, when.
#include <cstdint>
#include <string>

#include "robots/robot_config.h"
#include "signals/enumeration.h"
#include "signals/modes.h"
#include "signals/vec3.h"
#include "simulation/in_process/inprocess_robot.h"

namespace sprung::campaign {

/// What `--only` chooses between.
enum class Class : std::uint8_t {
  kNone,     ///< nothing goes wrong: the robot must not be stopped
  kDrive,    ///< of one drive, or of what it says
  kBus,      ///< of one bus, or of half of them
  kMessage,  ///< a link between two programs
  kField,    ///< a number in a message of a program that has gone wrong
  kProcess,  ///< a program that is killed, stopped, or too slow
  kForeign,  ///< frames of somebody else on the bus
  kFile,     ///< robot.yaml says what is not true of the machine, and every check was passed
};
constexpr auto words_of(Class) {
  using E = Class;
  return words<E>({{E::kNone, "none"},
                   {E::kDrive, "drive"},
                   {E::kBus, "bus"},
                   {E::kMessage, "message"},
                   {E::kField, "field"},
                   {E::kProcess, "process"},
                   {E::kForeign, "foreign"},
                   {E::kFile, "file"}});
}

/// Channels between the programs.
enum class Link : std::uint8_t { kDriveState, kJointState, kLegCommand, kDriveCommand, kImu };
constexpr auto words_of(Link) {
  using E = Link;
  return words<E>({{E::kDriveState, "DRIVE_STATE"},
                   {E::kJointState, "JOINT_STATE"},
                   {E::kLegCommand, "LEG_COMMAND"},
                   {E::kDriveCommand, "DRIVE_COMMAND"},
                   {E::kImu, "IMU"}});
}

enum class LinkFault : std::uint8_t {
  kLost,      ///< value: share
  kLate,      ///< value: cycles
  kRepeated,  ///< the first one again and again, with its own number
  kFuture,    ///< value: cycles ahead in its number
  kDisorder,  ///< each second one behind the one that was sent after it
  kFlipped,   ///< one bit turned over on the wire; value: share
};
constexpr auto words_of(LinkFault) {
  using E = LinkFault;
  return words<E>({{E::kLost, "lost"},
                   {E::kLate, "late"},
                   {E::kRepeated, "repeated"},
                   {E::kFuture, "future"},
                   {E::kDisorder, "out of order"},
                   {E::kFlipped, "with a bit flipped"}});
}

enum class FieldFault : std::uint8_t { kNaN, kInfinite, kHuge, kSign };
constexpr auto words_of(FieldFault) {
  using E = FieldFault;
  return words<E>({{E::kNaN, "NaN"}, {E::kInfinite, "infinite"}, {E::kHuge, "huge"}, {E::kSign, "sign"}});
}

enum class ProcessFault : std::uint8_t {
  kKilled,
  kStopped,  ///< SIGSTOP for duration_s
  kBusy,     ///< answers only every second to fifth cycle (value) for duration_s
};
constexpr auto words_of(ProcessFault) {
  using E = ProcessFault;
  return words<E>({{E::kKilled, "killed"}, {E::kStopped, "stopped"}, {E::kBusy, "busy"}});
}

enum class Foreign : std::uint8_t { kPreOperational, kReset, kStopNode, kSetpoint, kHeartbeat, kSync };
constexpr auto words_of(Foreign) {
  using E = Foreign;
  return words<E>({{E::kPreOperational, "NMT pre-operational"},
                   {E::kReset, "NMT reset"},
                   {E::kStopNode, "NMT stop"},
                   {E::kSetpoint, "set-point"},
                   {E::kHeartbeat, "heartbeat of the master"},
                   {E::kSync, "SYNC"}});
}

enum class FileMistake : std::uint8_t { kSign, kSwapped, kZero, kRatio };
constexpr auto words_of(FileMistake) {
  using E = FileMistake;
  return words<E>({{E::kSign, "direction"},
                   {E::kSwapped, "two node ids swapped"},
                   {E::kZero, "zero"},
                   {E::kRatio, "torque constant"}});
}

/// Only the members of its class mean something.
struct Injection {
  Class kind = Class::kNone;
  std::int64_t at_seq = -1;  ///< the cycle in which it begins
  double duration_s = 0.0;   ///< 0: for good
  int target = 0;            ///< actuator, bus, joint or leg
  bool half_of_buses = false;
  FaultKind drive_fault = FaultKind::kNone;
  Link link = Link::kDriveState;
  LinkFault link_fault = LinkFault::kLost;
  FieldFault field_fault = FieldFault::kNaN;
  int field = 0;  ///< of those that fields_of() lists for the link
  StackProcess process = StackProcess::kBridge;
  ProcessFault process_fault = ProcessFault::kKilled;
  Foreign foreign = Foreign::kSetpoint;
  FileMistake mistake = FileMistake::kSign;
  double value = 0.0;

  bool active(std::int64_t seq, double cycle_s) const noexcept {
    return at_seq >= 0 && seq >= at_seq &&
           (duration_s == 0.0 || static_cast<double>(seq - at_seq) * cycle_s < duration_s);
  }
};

/// "encoder-stuck of fl_knee_motor for 0.31 s".
std::string text_of(const Injection& injection, const RobotConfig& robot);

/// The stack's robot.yaml with the mistake in it; of other classes as it was.
RobotConfig with_mistake(RobotConfig robot, const Injection& injection);

}  // namespace sprung::campaign
