#include "drivers/bridge/traced_frame_shell.h"

#include <algorithm>

namespace sprung {
namespace {

// As SocketCAN marks them (linux/can.h).
constexpr std::uint32_t kErrorFlag = 0x20000000;
constexpr std::uint32_t kRemoteFlag = 0x40000000;

}  // namespace

sprung_msgs::traced_frame_t traced_frame(int bus, const CanFrame& frame, bool sent, std::int64_t time_us) {
  const std::uint32_t flags = (frame.error ? kErrorFlag : 0U) | (frame.remote ? kRemoteFlag : 0U);
  sprung_msgs::traced_frame_t traced;
  traced.utime = time_us;
  traced.can_id = static_cast<std::int32_t>(frame.id | flags);
  traced.bus = static_cast<std::int8_t>(bus);
  traced.sent = sent ? 1 : 0;
  traced.dlc = static_cast<std::int8_t>(frame.length);
  std::copy(frame.data.begin(), frame.data.end(), traced.data);
  return traced;
}

}  // namespace sprung
