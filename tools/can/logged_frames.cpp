#include <algorithm>
#include <array>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "runtime/receive_guard.h"
#include "tools/can/decode/candump_text.h"
#include "tools/can/frame_source.h"

namespace sprung {

using cantools::ObservedFrame;

namespace {

constexpr std::uint32_t kErrorFlag = 0x20000000;
constexpr std::uint32_t kRemoteFlag = 0x40000000;
constexpr std::size_t kMostTraced = 256;  // lcmtypes/can_trace.lcm

std::int64_t count_of(const std::string& what, std::int64_t count, std::string& text) {
  if (count > 0) text += (text.empty() ? "" : "; ") + std::to_string(count) + " " + what;
  return count;
}

ObservedFrame from_trace(const sprung_msgs::traced_frame_t& traced) {
  ObservedFrame out;
  const auto id = static_cast<std::uint32_t>(traced.can_id);
  out.time_us = traced.utime;
  out.bus = traced.bus;
  out.direction = traced.sent != 0 ? cantools::Direction::kSent : cantools::Direction::kReceived;
  out.frame.id = id & ~(kErrorFlag | kRemoteFlag);
  out.frame.error = (id & kErrorFlag) != 0;
  out.frame.remote = (id & kRemoteFlag) != 0;
  out.frame.length = static_cast<std::uint8_t>(std::min<int>(std::max<int>(traced.dlc, 0), 8));
  std::copy_n(traced.data, 8, out.frame.data.begin());
  return out;
}

class LcmLogSource final : public FrameSource {
 public:
  LcmLogSource(const std::string& path, const std::vector<std::string>& buses)
      : log_(path, "r"),
        guard_(channels::kCanTrace, layout_of<sprung_msgs::can_trace_t>(), CountLimits::up_to(kMostTraced),
               0) {
    buses_ = buses;
    utc_offset_us_ = log_origin(path).utc_offset_us;
  }

  Read next(ObservedFrame& frame, int) override {
    while (at_ == trace_.frames.size()) {
      if (!read_trace()) return Read::kEnd;
    }
    frame = from_trace(trace_.frames[at_++]);
    while (frame.bus >= static_cast<int>(buses_.size()))
      buses_.push_back("bus" + std::to_string(buses_.size()));
    return Read::kFrame;
  }

  std::string losses() const override {
    std::string text;
    count_of("damaged CAN_TRACE messages left out", guard_.refused(), text);
    return text;
  }

 private:
  bool read_trace() {
    at_ = 0;
    trace_.frames.clear();
    while (const lcm::LogEvent* event = log_.readNextEvent()) {
      if (event->channel != channels::kCanTrace) continue;
      if (guard_.decode(event->data, static_cast<std::size_t>(event->datalen), trace_) == Refusal::kNone)
        return true;
      trace_.frames.clear();
    }
    return false;
  }

  lcm::LogFile log_;
  ReceiveGuard guard_;
  sprung_msgs::can_trace_t trace_{};
  std::size_t at_ = 0;
};

class CandumpSource final : public FrameSource {
 public:
  CandumpSource(const std::string& path, const std::vector<std::string>& buses,
                const std::vector<std::string>& interfaces)
      : path_(path), in_(path), interfaces_(interfaces) {
    buses_ = buses;
  }

  Read next(ObservedFrame& frame, int) override {
    std::string interface;
    while (std::getline(in_, line_)) {
      ++number_;
      const cantools::CandumpLine kind = cantools::parse_candump(line_, interface, frame);
      if (kind == cantools::CandumpLine::kBroken) refuse();
      foreign_ += kind == cantools::CandumpLine::kForeign ? 1 : 0;
      if (kind != cantools::CandumpLine::kFrame) continue;
      frame.bus = bus_of(interface);
      return Read::kFrame;
    }
    return Read::kEnd;
  }

  std::string losses() const override {
    std::string text;
    count_of("frames left out that are no classic 11-bit ones", foreign_, text);
    return text;
  }

 private:
  [[noreturn]] void refuse() const {
    throw std::runtime_error(path_ + ":" + std::to_string(number_) + ": '" + line_ +
                             "' is no line of candump; expected e.g. (1436509052.249713) can0 181#2A36");
  }

  int bus_of(const std::string& interface) {
    for (std::size_t i = 0; i < buses_.size(); ++i) {
      if (buses_[i] == interface || (i < interfaces_.size() && interfaces_[i] == interface))
        return static_cast<int>(i);
    }
    // A robot with one bus needs no agreement on its name.
    const bool only_bus = interfaces_.size() == 1 && buses_.size() == 1 && !adopted_;
    if (only_bus) {
      adopted_ = true;
      interfaces_.front() = interface;
      return 0;
    }
    buses_.push_back(interface);
    return static_cast<int>(buses_.size()) - 1;
  }

  std::string path_;
  std::ifstream in_;
  std::vector<std::string> interfaces_;
  bool adopted_ = false;  ///< the one bus has its interface
  std::string line_;
  int number_ = 0;
  std::int64_t foreign_ = 0;
};

}  // namespace

bool is_lcm_log(const std::string& path) {
  constexpr std::array<unsigned char, 4> kMagic{0xED, 0xA1, 0xDA, 0x01};
  std::ifstream in(path, std::ios::binary);
  std::array<char, 4> head{};
  if (!in) throw std::runtime_error("cannot read " + path + ": does it exist?");
  in.read(head.data(), head.size());
  return in && std::equal(kMagic.begin(), kMagic.end(), head.begin(),
                          [](unsigned char a, char b) { return a == static_cast<unsigned char>(b); });
}

LogOrigin log_origin(const std::string& path) {
  lcm::LogFile log(path, "r");
  ReceiveGuard guard(channels::kProcessStatus, layout_of<sprung_msgs::process_status_t>(),
                     CountLimits::none(), 0);
  sprung_msgs::process_status_t status;
  while (const lcm::LogEvent* event = log.readNextEvent()) {
    const bool says = event->channel == channels::kProcessStatus &&
                      guard.decode(event->data, static_cast<std::size_t>(event->datalen), status) ==
                          Refusal::kNone;
    if (says && !status.robot.empty()) return {status.robot, status.utc_offset_us};
  }
  return {};
}

std::unique_ptr<FrameSource> open_file_source(const std::string& path, const std::vector<std::string>& buses,
                                              const std::vector<std::string>& interfaces) {
  if (is_lcm_log(path)) return std::make_unique<LcmLogSource>(path, buses);
  return std::make_unique<CandumpSource>(path, buses, interfaces);
}

}  // namespace sprung
