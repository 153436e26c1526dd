#pragma once
/// One CAN bus, whatever carries it. Sending and receiving never block and never throw; opening may do both.
#include <cstdint>
#include <memory>
#include <string>

#include "drivers/can/can_frame.h"

namespace sprung {

/// Since opening. Everything that is lost is counted somewhere here.
struct CanBusCounters {
  std::int64_t sent = 0;
  std::int64_t received = 0;
  std::int64_t send_failed = 0;  ///< frames the kernel did not take: ENOBUFS, EAGAIN, link down
  std::int64_t dropped = 0;      ///< frames lost before we read them: receive queue full
  std::int64_t malformed = 0;    ///< datagrams or frames that are no classic 11-bit data frame; ignored
};

class CanBus {
 public:
  virtual ~CanBus() = default;
  CanBus(const CanBus&) = delete;
  CanBus& operator=(const CanBus&) = delete;

  /// Sends in order. @return false when not all frames were taken; the rest is dropped and counted, since a
  /// newer set-point follows and a stale one is worse than none (facts canopen section 5).
  virtual bool send(const CanFrame* frames, int count) noexcept = 0;
  /// @return frames read now, 0..max; never this endpoint's own.
  virtual int receive(CanFrame* frames, int max) noexcept = 0;
  /// The same with each frame's arrival at the kernel, us on CLOCK_MONOTONIC; back ends without kernel time stamps give the
  /// time of reading. Sampling jitter is what hurts an encoder's derivative most, and a process wakes up late.
  virtual int receive_timed(CanFrame* frames, std::int64_t* arrival_us, int max) noexcept;
  /// For poll(), readable when receive() may return something; -1 where there is no such descriptor.
  virtual int fd() const noexcept = 0;
  /// Address for people, e.g. "udp:239.74.163.2:43113".
  virtual std::string describe() const = 0;

  const CanBusCounters& counters() const noexcept { return counters_; }

 protected:
  CanBus() = default;
  CanBusCounters counters_;
};

/// Opens "socketcan:can0", "udp:239.74.163.2:43113" or "memory:NAME" (endpoints of one process that name the
/// same medium).
/// @throws std::invalid_argument when the address cannot be understood, naming the forms there are;
/// @throws std::runtime_error when the system refuses, saying what to do about it.
std::unique_ptr<CanBus> open_can_bus(const std::string& address);

}  // namespace sprung
