#include "tools/operate/launcher/run_conflict.h"

#include <algorithm>

namespace sprung {
namespace {

/// "udpm://239.255.76.67:7667" of an LCM url: ttl and buffers make no other network of it.
std::string network_of(const std::string& lcm_url) { return lcm_url.substr(0, lcm_url.find('?')); }

std::string shared_bus(const RunInfo& ours, const RunInfo& other) {
  for (const std::string& bus : ours.buses) {
    if (std::find(other.buses.begin(), other.buses.end(), bus) != other.buses.end()) return bus;
  }
  return "";
}

}  // namespace

std::string why_not_beside(const RunInfo& ours, const RunInfo& other) {
  if (ours.session == other.session) return "";
  const std::string who = "robot " + other.robot + " is up as instance '" + other.instance + "' on ";
  const std::string end_it = "or end that one: sprung down --instance " + other.instance;
  const std::string bus = shared_bus(ours, other);
  if (!bus.empty())
    return who + "the CAN bus " + bus + " too: choose another with --can BUS=ADDRESS, " + end_it;
  if (network_of(ours.lcm_url) == network_of(other.lcm_url))
    return who + "the LCM network " + network_of(other.lcm_url) +
           " too: choose another port with --lcm-url "
           "'udpm://239.255.76.67:PORT?ttl=0&recv_buf_size=4194304', " +
           end_it;
  return "";
}

std::string why_not_beside(const RunInfo& ours, const std::vector<RunInfo>& others) {
  for (const RunInfo& other : others) {
    std::string why = why_not_beside(ours, other);
    if (!why.empty()) return why;
  }
  return "";
}

}  // namespace sprung
