#include "runtime/transport/known_senders.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace sprung {
namespace {

std::uint32_t ipv4(const sockaddr* address) noexcept {
  sockaddr_in in{};
  std::memcpy(&in, address, sizeof in);
  return in.sin_addr.s_addr;
}

}  // namespace

std::vector<AddressRange> ranges_of_this_host(const std::string& interface) {
  // Where lo is all there is, and the group's route leads there, what this machine sends has no address
  // (lo's is of a narrower scope than the route). From outside Linux lets no such source in.
  std::vector<AddressRange> out{{htonl(INADDR_LOOPBACK), htonl(IN_CLASSA_NET)}, {htonl(INADDR_ANY)}};
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return out;
  for (const ifaddrs* one = list; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    out.push_back({ipv4(one->ifa_addr)});
    if (interface == one->ifa_name && one->ifa_netmask != nullptr)
      out.push_back({ipv4(one->ifa_addr), ipv4(one->ifa_netmask)});
  }
  freeifaddrs(list);
  return out;
}

KnownSenders::KnownSenders(std::string interface)
    : interface_(std::move(interface)), ranges_(ranges_of_this_host(interface_)) {}

bool KnownSenders::found(std::uint32_t address) const noexcept {
  return std::any_of(ranges_.begin(), ranges_.end(),
                     [&](const AddressRange& range) { return range.has(address); });
}

bool KnownSenders::has(std::uint32_t address, std::int64_t now_us) {
  if (found(address)) return true;
  if (now_us - looked_us_ < kLookAgain_us) return false;
  looked_us_ = now_us;
  ranges_ = ranges_of_this_host(interface_);
  return found(address);
}

}  // namespace sprung
