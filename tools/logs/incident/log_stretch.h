#pragma once
/// The stretches of a recording that tell of an incident, each copied into a log of its own. Shell: reads and
/// writes logs.
#include <optional>
#include <string>
#include <vector>

#include "tools/logs/incident/trip.h"
#include "tools/logs/log/log_info.h"

namespace sprung::log {

/// In the robot's time since the log's begin.
struct Stretch {
  std::string log;
  double from_s = 0.0;
  std::optional<double> to_s;  ///< nothing: to its end
};

/// Into a new log `to`. @return what is in that one.
LogInfo copy_stretch(const Stretch& stretch, const std::string& to, const Progress& progress = {});

/// The last seconds of a recording, into `folder`, a log for each part under the part's name.
/// @param parts newest first, as parts_back_from() of log_choice.h gives them. @return newest first.
std::vector<LogInfo> copy_last(const std::vector<std::string>& parts, double last_s,
                               const std::string& folder, const Progress& progress = {});

struct FoundTrip {
  std::string log;
  Trip trip;
};

/// The newest one whose beginning is in one of these whole logs. @param parts newest first.
std::optional<FoundTrip> find_trip(const std::vector<std::string>& parts, const Progress& progress = {});

}  // namespace sprung::log
