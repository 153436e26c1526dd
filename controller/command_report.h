#pragma once
/// What the leg controller says of its commands to people: their basis, and which limits acted. Pure; makes
/// texts only when there is something new to say.
#include <cstdint>
#include <string>

#include "controller/controller_core.h"

namespace sprung {

class CommandReport {
 public:
  enum class News {
    kNone,
    kLimits,  ///< a limit acted since the last text; at most once in kLimitsInterval_us
    kBasis,   ///< the basis changed, or this is the first
  };
  static constexpr std::int64_t kLimitsInterval_us = 1'000'000;

  News update(CommandBasis basis, const LimitCounts& limits, std::int64_t now_us);
  /// E.g. "leg command stale" or "commanded; limits acted: torque 12, rate 3". Counts are since the start.
  const std::string& text() const noexcept { return text_; }

 private:
  void write();

  CommandBasis basis_ = CommandBasis::kNoCommand;
  LimitCounts limits_;  ///< those in the text
  std::int64_t limits_due_us_ = 0;
  std::string text_;
};

}  // namespace sprung
