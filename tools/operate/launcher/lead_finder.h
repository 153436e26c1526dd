#pragma once
/// How `sprung up --host` on a second computer joins the run of the first: the launcher that has the bridge
/// says on PROCESS_STATUS which session runs and when it began.
#include <cstdint>
#include <optional>
#include <string>

#include "sprung_msgs/process_status_t.hpp"

namespace sprung {

inline constexpr const char* kLauncherProgram = "sprung-up";  ///< its name on PROCESS_STATUS

/// When a run began, on this computer's CLOCK_MONOTONIC, us. Pure. The clocks' UTC must agree: NTP or PTP.
/// @param utc_offset_us UTC minus the run's time, from the lead's status.
std::int64_t epoch_here_us(std::int64_t utc_offset_us, std::int64_t utc_here_us,
                           std::int64_t monotonic_here_us) noexcept;

/// The status of a launcher that leads this robot's run. @return nullopt after timeout_s, or when a stop was
/// requested.
/// @param refusal why what was heard cannot be read (another version of its message); left alone where there
/// is nothing to say.
std::optional<sprung_msgs::process_status_t> find_lead(const std::string& lcm_url, const std::string& robot,
                                                       double timeout_s, std::string* refusal = nullptr);

}  // namespace sprung
