#include "tools/operate/launcher/lead_finder.h"

#include <cmath>

#include "lcmtypes/channels.h"
#include "runtime/node.h"
#include "runtime/stop_request.h"
#include "signals/modes.h"

namespace sprung {

std::int64_t epoch_here_us(std::int64_t utc_offset_us, std::int64_t utc_here_us,
                           std::int64_t monotonic_here_us) noexcept {
  return monotonic_here_us - (utc_here_us - utc_offset_us);
}

std::optional<sprung_msgs::process_status_t> find_lead(const std::string& lcm_url, const std::string& robot,
                                                       double timeout_s, std::string* refusal) {
  InputQueue<sprung_msgs::process_status_t> statuses(256);
  Node node(NodeOptions{lcm_url, 0, 0, {}});  // any session
  node.subscribe_message(channels::kProcessStatus, CountLimits::none(), statuses);
  const Receiving receiving(node);
  const std::int64_t end_us = node.utime_us() + std::llround(timeout_s * 1e6);
  while (node.utime_us() < end_us && !stop_requested()) {
    node.wait_for_input(node.utime_us() + 50'000);
    while (auto status = statuses.pop()) {
      const bool leads = status->process == kLauncherProgram && status->robot == robot &&
                         static_cast<ProcessState>(status->state) < ProcessState::kStopping;
      if (leads) return status;
    }
  }
  if (refusal != nullptr && node.refused_messages() > 0) *refusal = node.last_refusal();
  return std::nullopt;
}

}  // namespace sprung
