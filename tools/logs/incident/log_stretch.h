#pragma once
/// The stretches of a recording that tell of an incident, each copied into a log of its own. Shell: reads and
/// writes logs.
#include <optional>
#include <string>
#include <vector>

#include "tools/logs/log/incidents.h"
#include "tools/logs/log/log_info.h"

namespace sprung::log {

/// A time that safety stopped the robot, from the first cause on until safety was well again or the log
/// ended. The first cause is the one that tells; what follows from it comes later.
struct Trip {
  Incident first;
  Incident last;             ///< of the same trip; equal to `first` where nothing followed
  bool from_before = false;  ///< it was there when the log began: `first` is not its beginning
};

/// The newest one of a log; nothing where safety stopped nothing. A start and an orderly end are no trips.
std::optional<Trip> last_trip(const std::vector<Incident>& incidents);

/// One or two lines, each with its time in `log`: what began it, and what safety said last where that is
/// another.
std::string trip_text(const std::optional<Trip>& trip, const std::string& log);

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
