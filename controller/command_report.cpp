#include "controller/command_report.h"

namespace sprung {

CommandReport::News CommandReport::update(CommandBasis basis, const LimitCounts& limits,
                                          std::int64_t now_us) {
  const bool changed = basis != basis_ || text_.empty();
  const bool acted = limits.total() != limits_.total();
  if (!changed && !(acted && now_us >= limits_due_us_)) return News::kNone;
  if (acted) limits_due_us_ = now_us + kLimitsInterval_us;
  basis_ = basis;
  limits_ = limits;
  write();
  return changed ? News::kBasis : News::kLimits;
}

void CommandReport::write() {
  text_ = name(basis_);
  const char* separator = "; limits acted: ";
  const auto add = [&](const char* limit, std::int64_t count) {
    if (count == 0) return;
    text_ += separator + std::string(limit) + " " + std::to_string(count);
    separator = ", ";
  };
  add("soft stop", limits_.soft_stop);
  add("torque", limits_.torque);
  add("speed", limits_.speed);
  add("power", limits_.power);
  add("rate", limits_.rate);
  add("position", limits_.position);
  add("velocity", limits_.velocity);
  add("window", limits_.window);
}

}  // namespace sprung
