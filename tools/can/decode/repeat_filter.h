#pragma once
/// For a listener on a lock-step bus, where bursts are sent again until they are answered: lets every
/// numbered frame through once. Pure; allocates.
#include <cstdint>
#include <set>
#include <tuple>

#include "drivers/can/lockstep_burst.h"
#include "drivers/can/udp_datagram.h"

namespace sprung::cantools {

class RepeatFilter {
 public:
  /// @return false for a frame that was seen already, and for the mark that ends an answer, which is no
  /// frame. Frames without a number (real time, other tools) always pass.
  bool is_new(const StampedFrame& stamped);

 private:
  /// Master and drives number their bursts alike, so the frame's identifier tells them apart.
  using Key = std::tuple<std::int64_t, int, int, std::uint32_t, bool>;
  void forget_before(std::int64_t tick);

  std::set<Key> seen_;
  std::int64_t newest_ = -1;
};

}  // namespace sprung::cantools
