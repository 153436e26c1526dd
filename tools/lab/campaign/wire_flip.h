#pragma once
/// One bit of a message turns over on its way: what a bad memory or a bad cable's checksum lets through.
#include <cstdint>

#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/sensors.h"

namespace sprung::campaign {

/// Encodes the message with its MAC as its sender does, turns one bit over, and lets the receivers' own guard
/// judge. Allocates.
/// @param random which bit: its number modulo those of the message.
/// @return whether it arrives; `message` is then what its receiver reads.
bool arrives_flipped(DriveState& message, std::uint64_t random);
bool arrives_flipped(JointState& message, std::uint64_t random);
bool arrives_flipped(LegCommand& message, std::uint64_t random);
bool arrives_flipped(DriveCommand& message, std::uint64_t random);
bool arrives_flipped(Imu& message, std::uint64_t random);

}  // namespace sprung::campaign
