#include "tools/logs/replay/lcm_replay.h"

#include <lcm/lcm.h>
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "lcmtypes/channels.h"
#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "runtime/transport/lcm_address.h"
#include "tools/logs/log/channel_filter.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/timeline.h"
#include "tools/logs/recorder/gap_tracker.h"

namespace sprung {

std::int64_t ReplayPace::due_us(double time_s, std::int64_t now_us) noexcept {
  if (!(speed_ > 0.0)) return now_us;
  if (!begun_) {
    begun_ = true;
    first_s_ = time_s;
    first_us_ = now_us;
  }
  return first_us_ + std::llround((time_s - first_s_) / speed_ * 1e6);
}

ChannelNames::ChannelNames(const std::vector<std::string>& remaps) {
  for (const std::string& remap : remaps) {
    const std::size_t sign = remap.find('=');
    if (sign == std::string::npos || sign == 0 || sign + 1 == remap.size())
      throw std::invalid_argument("--remap " + remap + ": write OLD=NEW");
    const std::string old_name = remap.substr(0, sign);
    const bool twice = std::any_of(names_.begin(), names_.end(),
                                   [&](const Name& name) { return name.old_name == old_name; });
    if (twice) throw std::invalid_argument("--remap " + remap + ": " + old_name + " has a new name already");
    names_.push_back({old_name, remap.substr(sign + 1)});
  }
}

const char* ChannelNames::of(const std::string& channel) noexcept {
  for (Name& name : names_) {
    if (channel != name.old_name) continue;
    name.used = true;
    return name.new_name.c_str();
  }
  return channel.c_str();
}

std::vector<std::string> ChannelNames::unused() const {
  std::vector<std::string> out;
  for (const Name& name : names_) {
    if (!name.used) out.push_back(name.old_name);
  }
  return out;
}

namespace {

struct LcmDeleter {
  void operator()(lcm_t* lcm) const noexcept { lcm_destroy(lcm); }
};

/// @return false when a stop was asked for meanwhile.
bool sleep_until(std::int64_t due_us) {
  for (std::int64_t left_us = due_us - monotonic_us(); left_us > 0; left_us = due_us - monotonic_us()) {
    if (stop_requested()) return false;
    const timespec timeout{left_us / 1'000'000, (left_us % 1'000'000) * 1000};
    pollfd stop{stop_fd(), POLLIN, 0};  // poll ignores fd -1
    ppoll(&stop, 1, &timeout, nullptr);
  }
  return !stop_requested();
}

class LcmReplay {
 public:
  LcmReplay(const LcmReplayRequest& request, const StepGate& gate)
      : request_(request),
        gate_(gate),
        filter_(request.channels, request.drop),
        names_(request.remaps),
        reader_(request.log),
        lcm_(lcm_create(LcmAddress::of(request.lcm_url).url().c_str())),
        pace_(gate ? 0.0 : request.speed) {
    if (!lcm_)
      throw std::runtime_error("LCM could not start on '" + request.lcm_url +
                               "': check the address, or run 'sprung doctor'");
  }

  LcmReplayResult run() {
    if (gate_) choose_step_channel();
    do {
      reader_.rewind();
      pace_.begin_again();
      const std::int64_t before = result_.messages;
      if (!lap()) break;
      ++result_.laps;
      if (result_.messages == before) break;  // nothing to send: a loop would never end
    } while (request_.loop);
    if (result_.laps > 0) result_.not_renamed = names_.unused();
    return result_;
  }

 private:
  /// @return false when it shall end.
  bool lap() {
    log::Timeline timeline;
    for (log::Event event; reader_.next(event);) {
      const double time_s = timeline.next(event).time_s;
      if (is_over(time_s)) return true;
      if (!is_sent(event, time_s)) continue;
      if (!sleep_until(pace_.due_us(time_s, monotonic_us()))) return false;
      if (gate_ && event.channel == step_channel_ && !gate_(time_s)) return false;
      send(event);
    }
    return true;
  }

  bool is_over(double time_s) const { return time_s > request_.start_s + request_.duration_s; }
  bool is_sent(const log::Event& event, double time_s) {
    return time_s >= request_.start_s && filter_.keeps(event.channel);
  }

  void choose_step_channel() {
    log::Timeline timeline;
    std::string first, first_cyclic;
    for (log::Event event; reader_.next(event);) {
      const double time_s = timeline.next(event).time_s;
      if (is_over(time_s)) break;
      if (!is_sent(event, time_s) || event.channel == channels::kLogMetadata) continue;
      if (first.empty()) first = event.channel;
      if (first_cyclic.empty() && has_every_cycle(event.channel)) first_cyclic = event.channel;
      if (event.channel != channels::kDriveState) continue;
      step_channel_ = event.channel;
      return;
    }
    step_channel_ = first_cyclic.empty() ? first : first_cyclic;
  }

  void send(const log::Event& event) {
    const std::string channel(event.channel);
    const int sent = lcm_publish(lcm_.get(), names_.of(channel), event.data,
                                 static_cast<unsigned>(event.size));
    ++result_.messages;
    if (sent != 0) ++result_.failed;
  }

  const LcmReplayRequest& request_;
  const StepGate& gate_;
  log::ChannelFilter filter_;
  ChannelNames names_;
  log::Reader reader_;
  std::unique_ptr<lcm_t, LcmDeleter> lcm_;
  ReplayPace pace_;
  std::string step_channel_;
  LcmReplayResult result_;
};

}  // namespace

LcmReplayResult replay_to_lcm(const LcmReplayRequest& request, const StepGate& gate) {
  return LcmReplay(request, gate).run();
}

}  // namespace sprung
