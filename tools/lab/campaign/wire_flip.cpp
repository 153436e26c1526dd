#include "tools/lab/campaign/wire_flip.h"

#include <array>
#include <memory>
#include <vector>

#include "lcmtypes/channels.h"
#include "runtime/message_key.h"
#include "runtime/receive_guard.h"
#include "signals/messages.h"
#include "tools/logs/recorder/log_messages.h"

namespace sprung::campaign {
namespace {

constexpr std::int64_t kSession = 1;

template <class Message, class Signal>
bool arrives(Signal& signal, const char* channel, const CountLimits& limits, std::uint64_t random) {
  static const auto key = std::make_shared<const MessageKey>(std::array<std::uint8_t, kKeyBytes>{1});
  Message message;
  to_message(signal, kSession, message);
  std::vector<std::uint8_t> bytes = message_bytes(message);
  key->seal(channel, bytes.data(), bytes.size());
  const std::uint64_t bit = random % (8 * bytes.size());
  bytes[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
  ReceiveGuard guard(channel, layout_of<Message>(), limits, kSession);
  guard.demand(key, true);
  return guard.decode(bytes.data(), bytes.size(), message) == Refusal::kNone && from_message(message, signal);
}

}  // namespace

bool arrives_flipped(DriveState& message, std::uint64_t random) {
  return arrives<sprung_msgs::drive_state_t>(message, channels::kDriveState,
                                             CountLimits::exactly(message.actuators.size()), random);
}

bool arrives_flipped(JointState& message, std::uint64_t random) {
  return arrives<sprung_msgs::joint_state_t>(message, channels::kJointState,
                                             CountLimits::exactly(message.joints.size(), message.legs.size()),
                                             random);
}

bool arrives_flipped(LegCommand& message, std::uint64_t random) {
  return arrives<sprung_msgs::leg_command_t>(message, channels::kLegCommand,
                                             CountLimits::exactly(message.legs.size()), random);
}

bool arrives_flipped(DriveCommand& message, std::uint64_t random) {
  return arrives<sprung_msgs::drive_command_t>(message, channels::kDriveCommand,
                                               CountLimits::exactly(message.actuators.size()), random);
}

bool arrives_flipped(Imu& message, std::uint64_t random) {
  return arrives<sprung_msgs::imu_t>(message, channels::kImu, CountLimits::none(), random);
}

}  // namespace sprung::campaign
