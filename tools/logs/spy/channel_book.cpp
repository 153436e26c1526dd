#include "tools/logs/spy/channel_book.h"

namespace sprung::spy {

void ChannelBook::add(std::int64_t arrival_us, std::string_view name, const std::uint8_t* data,
                      std::size_t size) {
  auto found = channels_.find(name);
  if (found == channels_.end()) {
    found = channels_.emplace(name, Channel{}).first;
    found->second.has_every_cycle = has_every_cycle(name);
  }
  Channel& channel = found->second;
  channel.statistics.add(arrival_us, size);
  channel.last.assign(data, data + size);
  channel.fault = decoder_.open(data, size, view_);
  if (channel.fault == fields::Fault::kUnknownType) return;
  if (channel.fault != fields::Fault::kNone) {
    ++channel.malformed;
    return;
  }
  if (channel.type != view_.layout()->type->name) channel.type = view_.layout()->type->name;
  channel.stamp = view_.stamp();
  if (channel.has_every_cycle && channel.stamp) channel.gaps.add(channel.stamp->seq);
  if (name == followed_) history_.add(arrival_us, view_);
}

const Channel* ChannelBook::find(std::string_view name) const noexcept {
  const auto found = channels_.find(name);
  return found == channels_.end() ? nullptr : &found->second;
}

bool ChannelBook::open_last(const Channel& channel, fields::MessageView& message) {
  return !channel.last.empty() &&
         decoder_.open(channel.last.data(), channel.last.size(), message) == fields::Fault::kNone;
}

void ChannelBook::follow(const std::string& name) {
  if (name == followed_) return;
  followed_ = name;
  history_.clear();
}

}  // namespace sprung::spy
