#include "drivers/bridge/mode_watch.h"

namespace sprung {

void ModeWatch::begin_operation(std::int8_t booted_with, std::int64_t time_us) noexcept {
  if (!told_) display_ = booted_with;
  confirmed_at_us_ = time_us;
  unconfirmed_us_ = 0;
}

void ModeWatch::restart() noexcept {
  unconfirmed_us_ = 0;
  told_ = false;
}

void ModeWatch::send(DriveMode mode, bool confirmed, std::int64_t time_us) noexcept {
  sent_ = mode;
  if (confirmed) confirmed_at_us_ = time_us;
  unconfirmed_us_ = time_us - confirmed_at_us_;
}

}  // namespace sprung
