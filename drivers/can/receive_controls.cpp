#include "drivers/can/receive_controls.h"

#include <cstdlib>
#include <cstring>

namespace sprung {
namespace {

std::int64_t to_us(const timespec& time) noexcept {
  return std::int64_t{time.tv_sec} * 1'000'000 + time.tv_nsec / 1000;
}

std::int64_t read_clock_us(clockid_t clock) noexcept {
  timespec now{};
  ::clock_gettime(clock, &now);
  return to_us(now);
}

}  // namespace

std::int64_t can_clock_us() noexcept { return read_clock_us(CLOCK_MONOTONIC); }

void UtcOffset::update() noexcept {
  const std::int64_t before_us = can_clock_us();
  const std::int64_t utc_us = read_clock_us(CLOCK_REALTIME);
  update(before_us, utc_us, can_clock_us());
}

void UtcOffset::update(std::int64_t before_us, std::int64_t utc_us, std::int64_t after_us) noexcept {
  const std::int64_t uncertainty_us = (after_us - before_us) / 2 + 1;
  const std::int64_t offset_us = utc_us - (before_us + after_us) / 2;
  if (std::abs(offset_us - us_) > uncertainty_us) us_ = offset_us;
}

bool ask_for_receive_controls(int fd) noexcept {
  const int on = 1;
  return ::setsockopt(fd, SOL_SOCKET, SO_RXQ_OVFL, &on, sizeof on) == 0 &&
         ::setsockopt(fd, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof on) == 0;
}

std::int64_t read_receive_controls(msghdr& header, std::int64_t utc_offset_us, KernelDrops& drops) noexcept {
  std::int64_t arrival_us = 0;
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SO_RXQ_OVFL) {
      std::uint32_t count = 0;
      std::memcpy(&count, CMSG_DATA(c), sizeof count);
      drops.total += static_cast<std::uint32_t>(count - drops.last);
      drops.last = count;
    } else if (c->cmsg_type == SCM_TIMESTAMPNS) {
      timespec arrival{};
      std::memcpy(&arrival, CMSG_DATA(c), sizeof arrival);
      arrival_us = to_us(arrival) - utc_offset_us;
    }
  }
  return arrival_us;
}

}  // namespace sprung
