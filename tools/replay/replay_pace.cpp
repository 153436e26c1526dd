#include "tools/replay/replay_pace.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

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
    const bool twice =
        std::any_of(names_.begin(), names_.end(), [&](const auto& pair) { return pair.first == old_name; });
    if (twice) throw std::invalid_argument("--remap " + remap + ": " + old_name + " has a new name already");
    names_.emplace_back(old_name, remap.substr(sign + 1));
  }
}

const char* ChannelNames::of(const std::string& channel) const noexcept {
  for (const auto& [old_name, new_name] : names_) {
    if (channel == old_name) return new_name.c_str();
  }
  return channel.c_str();
}

}  // namespace sprung
