#include "tools/logs/spy/channel_book.h"

#include <algorithm>
#include <cmath>

namespace sprung::spy {

void FieldHistory::add(std::int64_t arrival_us, const fields::MessageView& message) {
  if (message.layout() != layout_.get()) {
    clear();
    layout_ = message.keep_layout();
    samples_.resize(kSamples * layout_->fields.size());
  }
  if (rows_ > 0 && arrival_us >= last_us_ && arrival_us < last_us_ + kInterval_us) return;
  last_us_ = arrival_us;
  const std::size_t width = layout_->fields.size();
  for (std::size_t i = 0; i < width; ++i) samples_[next_ * width + i] = message.number(layout_->fields[i]);
  next_ = (next_ + 1) % kSamples;
  rows_ = std::min(rows_ + 1, kSamples);
}

void FieldHistory::clear() {
  layout_.reset();
  samples_.clear();
  rows_ = next_ = 0;
}

std::vector<double> FieldHistory::of(std::size_t field) const {
  std::vector<double> out;
  if (layout_ == nullptr || field >= layout_->fields.size()) return out;
  out.reserve(rows_);
  const std::size_t first = rows_ < kSamples ? 0 : next_;
  for (std::size_t i = 0; i < rows_; ++i)
    out.push_back(samples_[(first + i) % kSamples * layout_->fields.size() + field]);
  return out;
}

namespace {

constexpr std::int64_t kWindow_us = 2'000'000;
constexpr std::int64_t kSlowWindow_us = 30'000'000;
constexpr std::size_t kFew = 5;
constexpr double kSilence_us = 1e6;  // and twice the longest interval: then it is silent, not late

}  // namespace

void ChannelStatistics::add(std::int64_t arrival_us, std::size_t size) {
  ++messages_;
  recent_.push_back({arrival_us, size});
  const auto old = [&](std::int64_t window_us) { return recent_.front().time_us < arrival_us - window_us; };
  while ((recent_.size() > kFew && old(kWindow_us)) || old(kSlowWindow_us)) recent_.pop_front();
}

ChannelFigures ChannelStatistics::figures(std::int64_t now_us) const {
  ChannelFigures out;
  out.messages = messages_;
  if (recent_.empty()) return out;
  out.last_size = recent_.back().size;
  out.age_us = now_us - recent_.back().time_us;
  const auto intervals = static_cast<double>(recent_.size() - 1);
  const auto span_us = static_cast<double>(recent_.back().time_us - recent_.front().time_us);
  if (span_us <= 0.0) return out;
  const double mean_us = span_us / intervals;
  double squares = 0.0, bytes = 0.0;
  for (std::size_t i = 1; i < recent_.size(); ++i) {
    const auto interval_us = static_cast<double>(recent_[i].time_us - recent_[i - 1].time_us);
    squares += (interval_us - mean_us) * (interval_us - mean_us);
    out.longest_us = std::max(out.longest_us, interval_us);
    bytes += static_cast<double>(recent_[i].size);
  }
  out.jitter_us = std::sqrt(squares / intervals);
  if (static_cast<double>(out.age_us) > std::max(2.0 * out.longest_us, kSilence_us)) return out;
  out.rate_Hz = 1e6 / mean_us;
  out.bytes_per_s = 1e6 * bytes / span_us;
  return out;
}

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
