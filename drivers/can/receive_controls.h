#pragma once
/// What the kernel says beside a received frame: when it arrived, and how many were lost before it. Shared by
/// the back ends that read sockets.
#include <sys/socket.h>
#include <time.h>

#include <cstdint>

namespace sprung {

std::int64_t can_clock_us() noexcept;  ///< CLOCK_MONOTONIC: the clock of every arrival time

/// CLOCK_REALTIME (in which the kernel stamps) minus CLOCK_MONOTONIC. A process that is interrupted between
/// reading the two clocks gets a wrong difference; such a reading changes nothing, so stamps keep their
/// order.
class UtcOffset {
 public:
  void update() noexcept;
  /// @param before_us, after_us CLOCK_MONOTONIC around reading utc_us.
  void update(std::int64_t before_us, std::int64_t utc_us, std::int64_t after_us) noexcept;
  std::int64_t us() const noexcept { return us_; }

 private:
  std::int64_t us_ = 0;
};

/// Asks for both. @return false with errno set.
bool ask_for_receive_controls(int fd) noexcept;

/// Room for both.
inline constexpr std::size_t kReceiveControl_bytes = CMSG_SPACE(sizeof(std::uint32_t)) +
                                                     CMSG_SPACE(sizeof(timespec));

/// The kernel's counter of a socket wraps; this one does not.
struct KernelDrops {
  std::uint32_t last = 0;
  std::int64_t total = 0;
};

/// Counts drops. @return arrival, us on CLOCK_MONOTONIC; 0 when the kernel gave no stamp.
std::int64_t read_receive_controls(msghdr& header, std::int64_t utc_offset_us, KernelDrops& drops) noexcept;

}  // namespace sprung
