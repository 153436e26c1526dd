#pragma once
/// The last time that safety stopped the robot in a log, and how it began: the first cause is the one that
/// tells, what follows from it comes later. Pure.
#include <optional>
#include <string>
#include <vector>

#include "tools/logs/log/incidents.h"

namespace sprung::log {

/// From the first cause on until safety was well again, or the log ended.
struct Trip {
  Incident first;
  Incident last;             ///< of the same trip; equal to `first` where nothing followed
  bool from_before = false;  ///< it was there when the log began: `first` is not its beginning
};

/// The newest one; nothing where safety stopped nothing. A start and an orderly end are no trips.
std::optional<Trip> last_trip(const std::vector<Incident>& incidents);

/// One or two lines, each with its time in `log`: what began it, and what safety said last where that is
/// another.
std::string trip_text(const std::optional<Trip>& trip, const std::string& log);

}  // namespace sprung::log
