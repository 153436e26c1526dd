#include "tools/lab/identify/record_log.h"

#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "signals/messages.h"

namespace sprung::identify {

namespace {

constexpr std::int64_t kSession = 1;

}  // namespace

void write_drive_log(const std::string& path, const std::vector<DriveState>& states) {
  lcm::LogFile log(path, "w");
  bool good = log.good();
  sprung_msgs::drive_state_t message;
  std::vector<std::uint8_t> bytes;
  lcm::LogEvent event{};
  event.channel = channels::kDriveState;
  for (const DriveState& state : states) {
    if (!good) break;
    to_message(state, kSession, message);
    bytes.resize(static_cast<std::size_t>(message.getEncodedSize()));
    message.encode(bytes.data(), 0, message.getEncodedSize());
    event.timestamp = state.stamp.utime_us;
    event.datalen = static_cast<std::int32_t>(bytes.size());
    event.data = bytes.data();
    good = log.writeEvent(&event) == 0;
  }
  if (!good) throw std::runtime_error("cannot write " + path + ": does its folder exist, is there room?");
}

}  // namespace sprung::identify
