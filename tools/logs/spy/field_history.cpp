#include "tools/logs/spy/field_history.h"

#include <algorithm>

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

}  // namespace sprung::spy
