#include "drivers/can/can_interface.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace sprung {
namespace {

// [design choice] The kernel tells the rate that the controller's clock gives, not the one asked for;
// standard rates are 20 % apart and more.
constexpr double kRateTolerance = 0.01;
constexpr int kLongestQueue = 64;         // frames: 8 ms of a full bus at 1 Mbit/s
constexpr std::size_t kLongestName = 15;  // IFNAMSIZ - 1

using nlohmann::json;

InterfaceFacts facts_of(const json& link) {
  InterfaceFacts facts;
  facts.name = link.value("ifname", "");
  facts.queue_length = link.value("txqlen", 0);
  const json flags = link.value("flags", json::array());
  facts.up = std::find(flags.begin(), flags.end(), "UP") != flags.end();
  const json info = link.value("linkinfo", json::object());
  facts.kind = info.value("info_kind", "");
  const json data = info.value("info_data", json::object());
  facts.state = data.value("state", "");
  facts.restart_ms = data.value("restart_ms", 0);
  facts.bit_rate = data.value("bittiming", json::object()).value("bitrate", 0);
  return facts;
}

/// A name that a shell takes as one word.
bool plain(const std::string& name) {
  const auto good = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-' || c == '.'; };
  return !name.empty() && name.size() <= kLongestName && name[0] != '-' &&
         std::all_of(name.begin(), name.end(), good);
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  std::string text;
  char part[4096];
  while (pipe) {
    const std::size_t got = std::fread(part, 1, sizeof part, pipe.get());
    if (got == 0) break;
    text.append(part, got);
  }
  return text;
}

bool same_rate(int a, int b) { return std::abs(a - b) <= kRateTolerance * b; }

std::string rate_text(const InterfaceFacts& facts, int bit_rate) {
  const std::string wanted = std::to_string(bit_rate);
  return facts.name + ": bit rate is " + std::to_string(facts.bit_rate) + ", not " + wanted +
         " (ip link set " + facts.name + " down; ip link set " + facts.name + " up type can bitrate " +
         wanted + ")";
}

void advise_controller(const InterfaceFacts& facts, int bit_rate, std::vector<std::string>& advice) {
  const std::string set = "ip link set " + facts.name + " type can ";
  if (!same_rate(facts.bit_rate, bit_rate)) advice.push_back(rate_text(facts, bit_rate));
  if (facts.restart_ms == 0) {
    advice.push_back(facts.name + ": after bus-off it stays off for good (" + set + "restart-ms 100)");
  }
  if (facts.up && facts.state != "ERROR-ACTIVE") {
    advice.push_back(facts.name + ": controller is " + facts.state +
                     " (wiring, termination, a node that answers?)");
  }
}

}  // namespace

std::vector<std::string> interface_advice(const InterfaceFacts& facts, int frames_per_cycle, int bit_rate) {
  std::vector<std::string> advice;
  const std::string set = "ip link set " + facts.name + " ";
  if (!facts.up) advice.push_back(facts.name + ": is down (" + set + "up)");
  if (facts.kind != "can") return advice;  // vcan has neither controller nor queue
  advise_controller(facts, bit_rate, advice);
  const std::string queue = facts.name + ": transmit queue holds " + std::to_string(facts.queue_length) +
                            " frames";
  if (facts.queue_length > kLongestQueue) {
    advice.push_back(queue + ", old set-points would wait in it (" + set + "txqueuelen 32)");
  } else if (facts.queue_length < frames_per_cycle) {
    advice.push_back(queue + ", a cycle sends " + std::to_string(frames_per_cycle) + " (" + set +
                     "txqueuelen 32)");
  }
  return advice;
}

void check_bit_rate(const InterfaceFacts& facts, int bit_rate) {
  if (facts.kind != "can" || facts.bit_rate == 0 || same_rate(facts.bit_rate, bit_rate)) return;
  throw std::invalid_argument(rate_text(facts, bit_rate) + "; or is bit_rate in robot.yaml wrong?");
}

void require_virtual(const InterfaceFacts& facts) {
  if (facts.kind == "vcan") return;
  throw std::invalid_argument(
      facts.name + " is a real CAN interface, and this is a simulation (--sim): real " +
      "drives may be there, and would get its watchdogs. Leave --sim out, or give it " +
      "a bus of its own: --can BUS=udp:GROUP:PORT, or a vcan");
}

std::optional<InterfaceFacts> parse_interface(const std::string& text) {
  const json links = json::parse(text, nullptr, false);
  if (!links.is_array() || links.empty() || !links[0].is_object()) return std::nullopt;
  try {
    InterfaceFacts facts = facts_of(links[0]);
    if (links[0].value("link_type", "") != "can") return std::nullopt;
    return facts;
  } catch (const json::exception&) {  // a value of another type than iproute2's
    return std::nullopt;
  }
}

std::string interface_of(const std::string& address) {
  const std::string kind = "socketcan:";
  if (address.compare(0, kind.size(), kind) != 0) return "";
  return address.substr(kind.size(), address.find('?') - kind.size());
}

std::optional<InterfaceFacts> read_interface(const std::string& address) {
  const std::string name = interface_of(address);
  if (!plain(name)) return std::nullopt;
  return parse_interface(
      output_of("PATH=$PATH:/usr/sbin:/sbin ip -details -json link show dev " + name + " 2>/dev/null"));
}

}  // namespace sprung
