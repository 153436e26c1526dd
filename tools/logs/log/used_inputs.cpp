#include "tools/logs/log/used_inputs.h"

#include "runtime/message_layout.h"
#include "signals/message_mac.h"
#include "sprung_msgs/drive_command_t.hpp"

namespace sprung::log {

std::optional<UsedInputs> used_inputs(const std::uint8_t* data, std::size_t size) noexcept {
  // The message ends with both numbers and the MAC.
  constexpr std::size_t kNumber = sizeof(std::int64_t), kTail = 2 * kNumber + kMacBytes;
  if (size < kCountsOffset + kTail) return std::nullopt;
  if (read_int64(data, 0) != sprung_msgs::drive_command_t::getHash()) return std::nullopt;
  const std::size_t joints = size - kTail;
  return UsedInputs{read_int64(data, kSeqOffset), read_int64(data, joints),
                    read_int64(data, joints + kNumber)};
}

}  // namespace sprung::log
