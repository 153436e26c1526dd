#pragma once
/// Stop-and-wait bursts over one udp: bus for lock-step runs: thin shell over UdpBus around lockstep_burst.h.
/// One link a bus.
///
/// Bridge, tick k:  add(set-points of k-1); add(begin_tick frames); send_burst(k);
///                  poll() until kComplete with tick() == k; after 50 ms of wall time resend().
/// Drives:          poll() until kComplete; step; add(what the drives sent);
///                  send_answer(tick()); on kRepeat resend().
#include <memory>
#include <vector>

#include "drivers/can/lockstep_burst.h"
#include "drivers/can/udp_bus.h"

namespace sprung {

/// For tests of the link itself: what happens to one frame of one burst, the first time it is sent.
struct BurstFault {
  enum class Kind : std::int8_t { kDrop, kRepeat };
  std::int64_t tick = 0;
  int index = 0;
  Kind kind = Kind::kDrop;
};

struct LinkCounters {
  std::int64_t bursts_sent = 0;
  std::int64_t bursts_received = 0;
  std::int64_t resent = 0;     ///< bursts sent again
  std::int64_t unstamped = 0;  ///< frames of others on this bus; ignored, since lock-step admits no outsiders
  std::int64_t overflow = 0;   ///< frames beyond kMaxBurst, dropped
};

enum class LinkEvent : std::int8_t { kNothing, kComplete, kRepeat };

class LockstepLink {
 public:
  explicit LockstepLink(std::unique_ptr<UdpBus> bus, std::vector<BurstFault> faults = {});

  /// Collects frames of the next burst: those of `batch` that are for this link's bus.
  void add(const FrameBatch& batch, int bus) noexcept;
  void send_burst(std::int64_t tick) noexcept;
  /// Closes with the end-of-tick mark, so it may be empty.
  void send_answer(std::int64_t tick) noexcept;
  /// The last burst or answer again, with all its frames.
  void resend() noexcept;

  /// A plain frame outside any burst, for tools and for drives whose master is gone.
  void send_unstamped(const CanFrame& frame) noexcept { bus_->send(&frame, 1); }

  /// Plain frames of others since the last call, the first 64: they are no part of a lock-step run, but
  /// drives whose master is gone may answer them.
  std::vector<CanFrame> take_outsiders() noexcept;

  /// Reads what has come in, up to the first event or 256 frames; call until kNothing. Never blocks; wait
  /// with poll() on fd().
  LinkEvent poll() noexcept;
  std::int64_t tick() const noexcept { return assembler_.tick(); }
  /// Of the last complete burst, in order, without the mark. Valid until the next poll().
  const std::vector<CanFrame>& frames() const noexcept { return received_; }
  /// Gives up everything before `tick`.
  void expect(std::int64_t tick) noexcept { assembler_.expect(tick); }

  int fd() const noexcept { return bus_->fd(); }
  const CanBus& bus() const noexcept { return *bus_; }
  const LinkCounters& counters() const noexcept { return counters_; }

 private:
  void send(std::int64_t tick) noexcept;
  void send_with_faults(std::int64_t tick) noexcept;
  bool touched_by_faults(std::int64_t tick) const noexcept;

  std::unique_ptr<UdpBus> bus_;
  std::vector<BurstFault> faults_;
  std::vector<CanFrame> outgoing_;
  std::vector<StampedFrame> stored_;  ///< last burst sent
  BurstAssembler assembler_;
  std::vector<CanFrame> received_;
  std::vector<CanFrame> outsiders_;
  LinkCounters counters_;
};

}  // namespace sprung
