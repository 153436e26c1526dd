#include "tools/logs/replay/replay_pace.h"

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

}  // namespace sprung
