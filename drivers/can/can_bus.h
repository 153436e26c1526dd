#pragma once
/// One CAN bus, whatever carries it. Sending and receiving never block and never throw; opening may do both.
#include <cstdint>
#include <memory>
#include <string>

#include "drivers/can/can_fd_frame.h"
#include "drivers/can/can_filter.h"
#include "drivers/can/can_frame.h"

namespace sprung {

/// Why the last send() did not take all frames.
enum class CanSendError : std::int8_t {
  kNone,
  kNoBuffers,  ///< the interface's queue is full (ENOBUFS), or the socket's (EAGAIN): the bus is slower than
               ///< we are
  kLinkDown,   ///< the interface is down or gone
  kOther,
};
const char* text(CanSendError error) noexcept;

/// Since opening. Everything that is lost is counted somewhere here.
struct CanBusCounters {
  std::int64_t sent = 0;
  std::int64_t received = 0;
  std::int64_t send_failed = 0;  ///< frames the kernel did not take, all reasons
  std::int64_t no_buffers = 0;   ///< of these: CanSendError::kNoBuffers
  std::int64_t link_down = 0;    ///< of these: CanSendError::kLinkDown
  std::int64_t dropped = 0;      ///< frames lost before we read them: receive queue full
  std::int64_t malformed = 0;    ///< datagrams or frames that are no classic 11-bit frame; ignored
  std::int64_t fd_frames = 0;    ///< CAN FD frames of others; see receive_fd()
  /// Own frames that came back from the bus after they were sent on it (socketcan only); those that pass the
  /// filter.
  std::int64_t confirmed = 0;
  std::int64_t confirmation_us = 0;          ///< from send() to being on the bus, newest
  std::int64_t longest_confirmation_us = 0;  ///< since opening
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
  /// The same with each frame's arrival at the kernel, us on CLOCK_MONOTONIC; back ends without kernel time
  /// stamps give the time of reading. Sampling jitter is what hurts an encoder's derivative most, and a
  /// process wakes up late.
  virtual int receive_timed(CanFrame* frames, std::int64_t* arrival_us, int max) noexcept;
  /// CAN FD frames that came since the last call, for people to look at: CANopen here is classic, so that
  /// receive() never gives one, nor a part of one. Only a bus that was opened for them has any (?fd=1); what
  /// is not fetched is forgotten, the oldest first.
  /// @return frames read now, 0..max.
  virtual int receive_fd(CanFdFrame* frames, int max) noexcept;
  /// Only frames that pass wake up and are received, so that foreign traffic costs nothing; count 0 = all
  /// again. Not for the loop.
  /// @return false where this back end lets everything through: udp: and memory: carry no foreign traffic
  /// worth the work, and whoever receives must ignore unknown ids anyway.
  virtual bool accept_only(const CanFilter* filters, int count);
  /// For poll(), readable when receive() may return something; -1 where there is no such descriptor.
  virtual int fd() const noexcept = 0;
  /// Address for people, e.g. "udp:239.74.163.2:43113".
  virtual std::string describe() const = 0;

  const CanBusCounters& counters() const noexcept { return counters_; }
  /// Of the last send(); kNone when it took everything.
  CanSendError last_send_error() const noexcept { return last_send_error_; }

 protected:
  CanBus() = default;
  CanBusCounters counters_;
  CanSendError last_send_error_ = CanSendError::kNone;
};

/// Opens "socketcan:can0", "socketcan:can0?fd=1" (which hears CAN FD too), "udp:239.74.163.2:43113" or
/// "memory:NAME" (endpoints of one process that name the same medium).
/// @throws std::invalid_argument when the address cannot be understood, naming the forms there are;
/// @throws std::runtime_error when the system refuses, saying what to do about it.
std::unique_ptr<CanBus> open_can_bus(const std::string& address);

}  // namespace sprung
