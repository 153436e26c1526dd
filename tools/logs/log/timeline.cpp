#include "tools/logs/log/timeline.h"

#include "lcmtypes/channels.h"
#include "tools/logs/recorder/gap_tracker.h"

namespace sprung::log {

Timeline::Moment Timeline::next(const Event& event) {
  // Of a stretch that was cut out LOG_METADATA comes along from the old log's begin.
  if (event.channel == channels::kLogMetadata && !begun_) return {0.0, stamps_.read(event.data, event.size)};
  if (!begun_) {
    begun_ = true;
    begin_us_ = event.time_us;
    received_ = {0.0, event.time_us};
  }
  Moment moment;
  moment.stamp = stamps_.read(event.data, event.size);
  moment.time_s = received_.time_of_s(event.time_us);
  if (moment.stamp && moment.stamp->seq >= 0 && has_every_cycle(event.channel)) {
    if (!robot_ || moment.stamp->session != session_) robot_ = Anchor{moment.time_s, moment.stamp->utime_us};
    session_ = moment.stamp->session;
    moment.time_s = robot_->time_of_s(moment.stamp->utime_us);
    received_ = {moment.time_s, event.time_us};
  }
  return moment;
}

}  // namespace sprung::log
