#pragma once
/// What commissioning must know of a make: which objects say how motor, encoder and limits are set, what
/// robot.yaml wants there, and how a small current is asked for over SDO. Pure data, made at start-up by
/// DriveProfile::commissioning().
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/canopen/protocol.h"
#include "signals/enumeration.h"

namespace sprung {

/// The step that an object belongs to.
enum class CommissioningTopic : std::int8_t { kMotor, kEncoder, kCurrentLoop, kLimits, kBitRate, kNodeId };
constexpr auto words_of(CommissioningTopic) {
  using E = CommissioningTopic;
  return words<E>({{E::kMotor, "motor"},
                   {E::kEncoder, "encoder"},
                   {E::kCurrentLoop, "current loop gains"},
                   {E::kLimits, "limits"},
                   {E::kBitRate, "bit rate"},
                   {E::kNodeId, "node id"}});
}

struct CommissioningObject {
  CommissioningTopic topic = CommissioningTopic::kMotor;
  canopen::ObjectId object;
  int size = 0;  ///< bytes
  bool is_signed = false;
  std::int64_t low = 0;  ///< of `mask`ed values that are right
  std::int64_t high = 0;
  std::uint32_t mask = 0xFFFFFFFF;
  std::string expected;         ///< in words, with where it comes from: "12 (pole_pairs of robot.yaml)"
  bool may_be_written = false;  ///< `low` can be written when the operator agrees: its meaning is confirmed
};

struct CommissioningPlan {
  std::vector<CommissioningObject> objects{};
  std::string not_readable{};  ///< what this make keeps where no confirmed object shows it, and how to look

  // A current set-point by SDO, the power stage on: i16 each. Signs are the motor's own.
  std::int8_t torque_mode = 0;  ///< 0x6060; 0 = commissioning cannot ask for torque
  canopen::ObjectId setpoint{};
  double A_per_setpoint = 0.0;  ///< by robot.yaml's ratings
  canopen::ObjectId measured_current{};
  double A_per_measured = 0.0;
  canopen::ObjectId position{};  ///< i32, counts of the motor
  double rad_per_count = 0.0;    ///< of the output, in actuator space, with robot.yaml's direction
  canopen::ObjectId inputs{};
  canopen::ObjectId last_error{};  ///< code of the newest fault, low 16 bits
};

}  // namespace sprung
