#pragma once
/// Whose datagrams are heard: this machine's own, and with an interface also those of the hosts in its
/// network. Linux lets no datagram in from outside that says it came from an address of this machine
/// (ip_mc_validate_source; `accept_local` is off), so the address of a sender that claims to be here is true.
#include <cstdint>
#include <string>
#include <vector>

namespace sprung {

/// IPv4, network order: everybody with `address & mask` equal.
struct AddressRange {
  std::uint32_t address = 0;
  std::uint32_t mask = 0xffffffff;
  bool has(std::uint32_t other) const noexcept { return (other & mask) == (address & mask); }
};

/// This machine's addresses as they are now, 127.0.0.0/8 and 0.0.0.0 among them, and the network of
/// `interface` unless it is empty.
std::vector<AddressRange> ranges_of_this_host(const std::string& interface);

class KnownSenders {
 public:
  static constexpr std::int64_t kLookAgain_us = 1'000'000;

  explicit KnownSenders(std::string interface);
  /// Addresses come and go (DHCP): a stranger makes it look again, at most once in kLookAgain_us.
  bool has(std::uint32_t address, std::int64_t now_us);

 private:
  bool found(std::uint32_t address) const noexcept;

  std::string interface_;
  std::vector<AddressRange> ranges_;
  std::int64_t looked_us_ = 0;
};

}  // namespace sprung
