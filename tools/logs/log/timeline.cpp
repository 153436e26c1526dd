#include "tools/logs/log/timeline.h"

#include "lcmtypes/channels.h"
#include "runtime/message_layout.h"
#include "tools/logs/recorder/gap_tracker.h"

namespace sprung::log {

namespace {

constexpr std::size_t kStampEnd = kSeqOffset + 8;
constexpr std::size_t kUtimeOffset = 16;

bool begins_with_stamp(const fields::StructType* type) {
  const char* const names[] = {"session", "utime", "seq"};
  if (type == nullptr || type->members.size() < std::size(names)) return false;
  for (std::size_t i = 0; i < std::size(names); ++i) {
    const fields::Member& member = type->members[i];
    if (member.name != names[i] || member.wire != fields::Wire::kInt64 || !member.dimensions.empty())
      return false;
  }
  return true;
}

}  // namespace

std::optional<SessionStamp> StampReader::read(const std::uint8_t* data, std::size_t size) {
  if (size < kStampEnd) return std::nullopt;
  const std::int64_t hash = read_int64(data, 0);
  auto found = stamped_.find(hash);
  if (found == stamped_.end()) found = stamped_.emplace(hash, begins_with_stamp(types_.by_hash(hash))).first;
  if (!found->second) return std::nullopt;
  return SessionStamp{read_int64(data, kSessionOffset), read_int64(data, kUtimeOffset),
                      read_int64(data, kSeqOffset)};
}

Timeline::Moment Timeline::next(const Event& event) {
  // Of a stretch that was cut out LOG_METADATA may come along from the old log's begin.
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
