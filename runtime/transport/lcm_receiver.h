#pragma once
/// Receives LCM's messages off its multicast network in place of LCM, whose own receiver ends the process on
/// one malformed datagram (lcm-proj/lcm#628), hears every network of the machine, and takes two changes of
/// threads a message. The wire is LCM's: its tools see and send as ever, and sending is left to it.
///
/// Bound to the group, so nothing that was sent to a machine's own address comes in; only datagrams of known
/// senders are looked at. One thread at a time; memory is taken in the constructor, and for fragments within
/// the limits of FragmentStore.
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "runtime/transport/fragment_store.h"
#include "runtime/transport/known_senders.h"
#include "runtime/transport/lcm_address.h"
#include "runtime/transport/lcm_packet.h"

namespace sprung {

struct ReceivedMessage {
  std::int64_t utc_us = 0;   ///< when the kernel had it (its last piece), since 1970
  std::string_view channel;  ///< this and data: valid in the handler only
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/// Fragments are for messages above 64 kB. Nothing that commands has such.
enum class Fragments : std::uint8_t { kRefused, kPutTogether };

struct ReceiverCounts {
  std::int64_t strangers = 0;  ///< datagrams of hosts that are not heard
  std::int64_t malformed = 0;  ///< what LCM never sends
  std::int64_t fragments = 0;  ///< refused, of too large messages, at odds with others
  std::int64_t lost = 0;       ///< by the kernel: its buffer was full
};

class LcmReceiver {
 public:
  /// Hears from now on. @throws std::invalid_argument for the address, std::runtime_error when the system
  /// refuses, saying what to do.
  LcmReceiver(const std::string& url, Fragments fragments);
  ~LcmReceiver();
  LcmReceiver(const LcmReceiver&) = delete;
  LcmReceiver& operator=(const LcmReceiver&) = delete;

  int fd() const noexcept;  ///< readable when something came in

  /// Hands out what is there now, one batch at most, in the order of arrival; never waits.
  /// @return whether there may be more.
  template <class Handle>  // void(const ReceivedMessage&), which does not throw
  bool receive(Handle&& handle) {
    const int got = read_batch();
    ReceivedMessage message;
    for (int i = 0; i < got; ++i)
      if (take(i, message)) handle(static_cast<const ReceivedMessage&>(message));
    return got == kBatch;
  }

  /// Until now; by the thread that receives.
  const ReceiverCounts& counts() const noexcept { return counts_; }

 private:
  static constexpr int kBatch = 16;
  struct Socket;
  int read_batch() noexcept;
  bool take(int i, ReceivedMessage& out) noexcept;
  bool look_at(int i, ReceivedMessage& out);
  bool put_together(const DatagramSender& sender, const LcmPacket& packet, ReceivedMessage& out);

  std::unique_ptr<Socket> socket_;
  KnownSenders senders_;
  const Fragments fragments_;
  FragmentStore store_;
  ReceiverCounts counts_;
};

}  // namespace sprung
