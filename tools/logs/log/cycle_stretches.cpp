#include "tools/logs/log/cycle_stretches.h"

namespace sprung::log {

void CycleStretches::add(std::int64_t first, std::int64_t last) {
  if (first <= newest_.last || last < first) return;
  cycles_ += last - first + 1;
  if (first != newest_.last + 1) {
    newest_.first = first;
    if (++stretches_ <= static_cast<std::int64_t>(kShown)) first_.push_back({first, last});
  } else if (stretches_ <= static_cast<std::int64_t>(kShown)) {
    first_.back().last = last;
  }
  newest_.last = last;
}

std::string CycleStretches::text() const {
  std::string out;
  for (const CycleStretch& one : first_) {
    out += (out.empty() ? "" : ", ") + std::to_string(one.first);
    if (one.last > one.first) out += " to " + std::to_string(one.last);
  }
  const std::int64_t more = stretches_ - static_cast<std::int64_t>(first_.size());
  if (more > 0) out += " and " + std::to_string(more) + (more == 1 ? " stretch more" : " stretches more");
  return out;
}

}  // namespace sprung::log
