#pragma once
/// What a DRIVE_COMMAND in a log was made from. Pure.
#include <cstddef>
#include <cstdint>
#include <optional>

namespace sprung::log {

struct UsedInputs {
  std::int64_t seq = -1;  ///< of the command
  std::int64_t joint_state_seq = -1;
  std::int64_t leg_command_seq = -1;  ///< -1 = none yet
};

/// @return nothing of a message that is none, too short, or of another version of its type.
std::optional<UsedInputs> used_inputs(const std::uint8_t* data, std::size_t size) noexcept;

}  // namespace sprung::log
