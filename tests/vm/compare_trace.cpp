/// Does a wire-tap see what the bridge says that it sent and received? Compares CAN_TRACE in an LCM log with
/// what candump recorded (`candump -L`) of the same buses; prints the lines that tests/vm/run counts.
///   vm-compare-trace LOG.lcm CANDUMP.log INTERFACE...      interfaces in the order of robot.yaml's buses
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "drivers/can/can_frame.h"
#include "drivers/canopen/protocol.h"
#include "lcmtypes/channels.h"
#include "sprung_msgs/can_trace_t.hpp"

namespace sprung {
namespace {

constexpr std::uint32_t kErrorFlag = 0x20000000;

/// One bus: what was traced, in both directions, and what candump saw.
struct Bus {
  std::string interface;
  std::vector<CanFrame> boot_sent, sent, received, seen;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::stringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

/// "181#0011AABB"; error frames have eight digits before the mark.
bool parse_frame(const std::string& text, CanFrame& frame) {
  const std::size_t mark = text.find('#');
  if (mark == std::string::npos || mark > 8) return false;
  const auto id = static_cast<std::uint32_t>(std::stoul(text.substr(0, mark), nullptr, 16));
  frame.error = (id & kErrorFlag) != 0;
  frame.id = id & ~kErrorFlag;
  const std::string data = text.substr(mark + 1);
  frame.remote = !data.empty() && data[0] == 'R';
  for (std::size_t i = 0; !frame.remote && i + 1 < data.size() && frame.length < 8; i += 2) {
    frame.data[frame.length++] = static_cast<std::uint8_t>(std::stoul(data.substr(i, 2), nullptr, 16));
  }
  return true;
}

/// Lines like "(1700000000.123456) can0 181#0011".
bool read_candump(const char* path, std::vector<Bus>& buses) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    const std::vector<std::string> words = split(line, ' ');
    CanFrame frame;
    if (words.size() < 3 || !parse_frame(words[2], frame)) return false;
    for (Bus& bus : buses) {
      if (bus.interface == words[1]) bus.seen.push_back(frame);
    }
  }
  return true;
}

void take(const sprung_msgs::can_trace_t& trace, std::vector<Bus>& buses) {
  for (const sprung_msgs::traced_frame_t& traced : trace.frames) {
    CanFrame frame;
    frame.error = (static_cast<std::uint32_t>(traced.can_id) & kErrorFlag) != 0;
    frame.id = static_cast<std::uint32_t>(traced.can_id) & ~kErrorFlag;
    frame.length = static_cast<std::uint8_t>(traced.dlc);
    std::copy(traced.data, traced.data + 8, frame.data.begin());
    Bus& bus = buses.at(traced.bus);
    (traced.sent != 0 ? bus.sent : bus.received).push_back(frame);
    if (traced.sent != 0 && trace.seq < 0) bus.boot_sent.push_back(frame);
  }
}

bool read_log(const char* path, std::vector<Bus>& buses) {
  lcm::LogFile log(path, "r");
  if (!log.good()) return false;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    sprung_msgs::can_trace_t trace;
    if (event->channel == channels::kCanTrace && trace.decode(event->data, 0, event->datalen) >= 0) {
      take(trace, buses);
    }
  }
  return true;
}

/// The frames of `whole` whose ids `part` has: what the same side sent.
std::vector<CanFrame> with_ids_of(const std::vector<CanFrame>& part, const std::vector<CanFrame>& whole) {
  std::set<std::uint32_t> ids;
  for (const CanFrame& frame : part) ids.insert(frame.id);
  std::vector<CanFrame> kept;
  std::copy_if(whole.begin(), whole.end(), std::back_inserter(kept),
               [&](const CanFrame& frame) { return ids.count(frame.id) != 0; });
  return kept;
}

/// Those of `part` that are not in `whole` in the same order. A frame counts as found behind others only with
/// the next ones behind it: SYNCs are all alike, and one that was lost must not be taken for a later one.
std::vector<CanFrame> missing(const std::vector<CanFrame>& part, const std::vector<CanFrame>& all_seen) {
  constexpr std::ptrdiff_t kFarthest = 1000, kTogether = 8;
  const std::vector<CanFrame> whole = with_ids_of(part, all_seen);
  std::vector<CanFrame> lost;
  auto at = whole.begin();
  for (auto frame = part.begin(); frame != part.end(); ++frame) {
    if (at != whole.end() && *at == *frame) {
      ++at;
      continue;
    }
    const auto together = frame + std::min(kTogether, part.end() - frame);
    const auto end = at + std::min(kFarthest, whole.end() - at);
    const auto next = std::search(at, end, frame, together);
    if (next == end) {
      lost.push_back(*frame);
    } else {
      at = next + 1;
    }
  }
  return lost;
}

/// Frames of the set-up: what only a master sends (NMT, SDO requests).
std::vector<CanFrame> configuration(const std::vector<CanFrame>& frames) {
  std::vector<CanFrame> kept;
  std::copy_if(frames.begin(), frames.end(), std::back_inserter(kept), [](const CanFrame& frame) {
    const std::uint32_t function = frame.id & ~0x7FU;
    return !frame.error && (frame.id == canopen::kNmtId || function == canopen::kSdoClientBase);
  });
  return kept;
}

bool report(bool good, const std::string& interface, const char* what, std::size_t count, std::size_t of) {
  std::printf("vm: %s Trace.%s on %s (%zu of %zu frames)\n", good ? "ok" : "FAILED", what, interface.c_str(),
              count, of);
  return good;
}

/// For people.
void print_frames(const char* who, const std::vector<CanFrame>& frames) {
  std::printf("  %s:", who);
  for (const CanFrame& frame : frames) {
    std::printf(" %03X#", frame.id);
    for (int k = 0; k < frame.length; ++k) std::printf("%02X", frame.data[k]);
  }
  std::printf("\n");
}

/// Where two sequences part.
void print_difference(const std::vector<CanFrame>& said, const std::vector<CanFrame>& seen) {
  const auto [a, b] = std::mismatch(said.begin(), said.end(), seen.begin(), seen.end());
  std::printf("  part at frame %td\n", a - said.begin());
  print_frames("we say ", {a, a + std::min<std::ptrdiff_t>(5, said.end() - a)});
  print_frames("candump", {b, b + std::min<std::ptrdiff_t>(5, seen.end() - b)});
}

/// @param allowed how many may be missing.
bool report_seen(const Bus& bus, const char* what, const std::vector<CanFrame>& said, std::size_t allowed) {
  const std::vector<CanFrame> lost = missing(said, bus.seen);
  const bool good = !said.empty() && lost.size() <= allowed;
  for (std::size_t i = 0; i < std::min<std::size_t>(lost.size(), 10); ++i)
    print_frames("not seen", {lost[i]});
  return report(good, bus.interface, what, said.size() - lost.size(), said.size());
}

bool compare(const Bus& bus) {
  // The kernel drops what it has taken from us and not yet handed to candump when a link goes down, as here
  // once.
  constexpr std::size_t kLostWithTheLink = 8;
  const std::vector<CanFrame> said = configuration(bus.boot_sent);
  std::vector<CanFrame> seen = configuration(bus.seen);
  seen.resize(std::min(seen.size(), said.size()));
  bool good = report(!said.empty() && said == seen, bus.interface, "SetUpIsOnTheBusByteForByte", seen.size(),
                     said.size());
  if (!good) print_difference(said, seen);
  good &= report_seen(bus, "WhatWeSayWeSentIsSeen", bus.sent, kLostWithTheLink);
  good &= report_seen(bus, "WhatWeSayWeReceivedIsSeen", bus.received, 0);
  return good;
}

int run(int argc, char** argv) {
  std::vector<Bus> buses;
  for (int i = 3; i < argc; ++i) buses.push_back({argv[i], {}, {}, {}, {}});
  if (buses.empty() || !read_log(argv[1], buses) || !read_candump(argv[2], buses)) {
    std::printf("vm: FAILED Trace: cannot read %s and %s\n", argc > 1 ? argv[1] : "a log",
                argc > 2 ? argv[2] : "a dump");
    return 1;
  }
  bool good = true;
  for (const Bus& bus : buses) good &= compare(bus);
  return good ? 0 : 1;
}

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) { return sprung::run(argc, argv); }
