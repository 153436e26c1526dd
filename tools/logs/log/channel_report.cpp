#include "tools/logs/log/channel_report.h"

#include <algorithm>

#include "runtime/message_layout.h"

namespace sprung::log {

namespace {

constexpr std::size_t kFingerprint = 8;

}  // namespace

double ChannelReport::rate_Hz() const noexcept {
  const std::int64_t counted = messages - cycles.repeats;
  if (counted < 2 || !(last_s > first_s)) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(counted - 1) / (last_s - first_s);
}

ChannelCounter::ChannelCounter(std::string_view channel, const fields::TypeTable& types) : types_(types) {
  report_.cyclic = has_every_cycle(channel);
}

void ChannelCounter::note_type(const Event& event) {
  const std::int64_t hash = event.size < kFingerprint ? 0 : read_int64(event.data, 0);
  if (report_.messages > 0 && hash == hash_) return;
  const fields::StructType* const type = types_.by_hash(hash);
  const std::string name = type == nullptr ? "" : type->name;
  report_.type = report_.messages == 0 || name == report_.type ? name : "several types";
  hash_ = hash;
}

void ChannelCounter::add(const Event& event, const Timeline::Moment& moment) {
  note_type(event);
  if (report_.messages == 0) report_.first_s = report_.last_s = moment.time_s;
  if (moment.time_s - report_.last_s > report_.longest_pause_s) {
    report_.longest_pause_s = moment.time_s - report_.last_s;
    report_.longest_pause_at_s = report_.last_s;
  }
  report_.last_s = std::max(report_.last_s, moment.time_s);
  ++report_.messages;
  report_.bytes += event.size;
  if (report_.cyclic && moment.stamp) cycles_.add(moment.stamp->session, moment.stamp->seq);
}

ChannelReport ChannelCounter::report() const {
  ChannelReport report = report_;
  report.cycles = cycles_.counts();
  return report;
}

}  // namespace sprung::log
