#include "runtime/session_clock.h"

#include <ctime>

namespace sprung {
namespace {

std::int64_t read_us(clockid_t clock) noexcept {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * 1'000'000 + now.tv_nsec / 1'000;
}

}  // namespace

std::int64_t monotonic_us() noexcept { return read_us(CLOCK_MONOTONIC); }
std::int64_t utc_us() noexcept { return read_us(CLOCK_REALTIME); }

}  // namespace sprung
