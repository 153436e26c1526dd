#include "tools/operate/doctor/network_checks.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "runtime/transport/lcm_address.h"

namespace sprung::doctor {
namespace {

// facts L20, and `./setup` does the same.
constexpr const char* kAddRoute = "ip link set lo multicast on; ip route add 239.0.0.0/8 dev lo";
// Facts L12: what a burst of large messages needs.
constexpr std::int64_t kGoodBuffer_bytes = 4'194'304;

constexpr const char* kSeveralHosts =
    "sprung up --lcm-url 'udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304&interface=NAME' on every "
    "host, "
    "with the interface (ip address) of the network between them";

Check route_check(const KernelFacts& kernel) {
  if (kernel.multicast_device.empty())
    return fail("multicast route", "no route to 239.255.76.67: LCM cannot start", kAddRoute);
  return pass("multicast route", "239.255.76.67 by " + kernel.multicast_device);
}

Check loopback_check(const LoopbackFacts& loopback) {
  const std::string found = std::to_string(loopback.received) + " of " + std::to_string(loopback.sent) +
                            " messages came back on " + loopback.url;
  if (!loopback.error.empty()) return fail("LCM loop-back", loopback.error, kAddRoute);
  if (loopback.received == 0)
    return fail("LCM loop-back", found + ": a firewall, or a device without multicast",
                std::string("iptables -I INPUT -d 239.0.0.0/8 -j ACCEPT, or: ") + kAddRoute);
  if (loopback.received < loopback.sent)
    return warn("LCM loop-back", found, "sysctl -w net.core.rmem_max=4194304, and less load on this machine");
  return pass("LCM loop-back", found);
}

Check ttl_check(const LcmAddress& address, const RobotConfig* robot) {
  const bool several = robot != nullptr &&
                       std::any_of(robot->processes.begin(), robot->processes.end(),
                                   [](const ProcessConfig& process) { return !process.host.empty(); });
  const bool leaves = address.ttl > 0, hears = !address.interface.empty();
  const std::string found = "ttl=" + std::to_string(address.ttl) +
                            (hears ? ", interface=" + address.interface : "");
  if (several && !(leaves && hears))
    return fail("ttl", found + ", but robot.yaml has processes on other hosts", kSeveralHosts);
  if (!several && hears)
    return warn("ttl", found + ": every machine on that network is heard by the robot",
                "leave interface out");
  if (!several && leaves)
    return warn("ttl", found + ": every machine on this network hears the robot", "use ttl=0");
  return pass("ttl", found + (several ? "" : ": LCM stays on this machine"));
}

Check buffer_check(const KernelFacts& kernel, const LcmAddress& address) {
  const std::int64_t wanted = std::max<std::int64_t>(address.receive_buffer_bytes, kGoodBuffer_bytes);
  const std::string found = "net.core.rmem_max " + std::to_string(kernel.receive_buffer_bytes);
  if (kernel.receive_buffer_bytes >= wanted) return pass("receive buffer", found);
  const std::string set = "net.core.rmem_max=" + std::to_string(wanted);
  return warn("receive buffer", found + ", asked for are " + std::to_string(wanted) + ": bursts may be lost",
              "sysctl -w " + set + "; echo " + set + " > /etc/sysctl.d/60-sprung.conf");
}

}  // namespace

std::vector<Check> network_checks(const KernelFacts& kernel, const LoopbackFacts& loopback,
                                  const RobotConfig* robot) {
  LcmAddress address;
  try {
    address = LcmAddress::of(loopback.url);
  } catch (const std::invalid_argument& error) {
    return {route_check(kernel), fail("LCM address", error.what(), "give another --lcm-url")};
  }
  return {route_check(kernel), loopback_check(loopback), ttl_check(address, robot),
          buffer_check(kernel, address)};
}

}  // namespace sprung::doctor
