#pragma once
/// Puts LCM's fragments together, within limits: what comes from the network may take no more memory and no
/// more time than this. A message whose sender does not finish it is forgotten; so is the oldest one when
/// there are too many. Pieces of different senders never mix.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/transport/lcm_packet.h"

namespace sprung {

/// Who sent a datagram, as the kernel says.
struct DatagramSender {
  std::uint32_t address = 0;  ///< IPv4, network order
  std::uint16_t port = 0;     ///< network order
  bool operator==(const DatagramSender& other) const noexcept {
    return address == other.address && port == other.port;
  }
};

class FragmentStore {
 public:
  static constexpr std::size_t kLargestMessage = 16U << 20;  ///< bytes; larger ones are refused
  static constexpr std::size_t kMostBytes = 32U << 20;       ///< of all messages that are not whole yet
  static constexpr std::size_t kMostMessages = 64;           ///< that are not whole yet
  static constexpr std::int64_t kPatience_us = 1'000'000;    ///< between two pieces of one

  struct Message {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };

  /// @param packet a fragment that parse_lcm_packet() accepted.
  /// @return the message where this was its last piece, valid until the next add(); nullptr otherwise.
  const Message* add(const DatagramSender& sender, const LcmPacket& packet, std::int64_t now_us);
  std::int64_t refused() const noexcept { return refused_; }  ///< too large, twice, or at odds with others
  std::int64_t forgotten() const noexcept { return forgotten_; }  ///< messages that never became whole

 private:
  struct Open {
    DatagramSender sender;
    std::uint32_t seq = 0;
    std::int64_t touched_us = 0;
    std::size_t bytes_there = 0;
    std::uint16_t pieces_there = 0;
    std::vector<bool> there;  ///< by number
    Message message;
  };
  Open& open_for(const DatagramSender& sender, const LcmPacket& packet, std::int64_t now_us);
  void forget(std::size_t index);
  void forget_old(std::int64_t now_us);
  void make_room(std::size_t bytes);

  std::vector<Open> open_;
  std::size_t open_bytes_ = 0;
  Message whole_;
  std::int64_t refused_ = 0;
  std::int64_t forgotten_ = 0;
};

}  // namespace sprung
