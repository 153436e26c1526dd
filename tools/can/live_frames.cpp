#include <poll.h>

#include <algorithm>
#include <deque>

#include "drivers/can/bus_addresses.h"
#include "runtime/session_clock.h"
#include "tools/can/decode/repeat_filter.h"
#include "tools/can/frame_source.h"

namespace sprung {

using cantools::ObservedFrame;

namespace {

constexpr int kBatch = 64;
constexpr int kNoDescriptor_ms = 2;  // memory: has nothing to poll

/// One bus; on udp: with the numbers of lock-step.
class Listener {
 public:
  explicit Listener(const LiveBus& bus) {
    if (bus.address.rfind("udp:", 0) == 0) {
      udp_ = open_udp_bus(bus.address);
    } else {
      other_ = open_can_bus(bus.address);
    }
  }

  int read_fd(CanFdFrame* frames, int max) { return other_ ? other_->receive_fd(frames, max) : 0; }
  const CanBus& bus() const noexcept { return udp_ ? *udp_ : *other_; }

  void read(int index, std::deque<ObservedFrame>& out) {
    udp_ ? read_numbered(index, out) : read_plain(index, out);
  }

 private:
  void read_numbered(int index, std::deque<ObservedFrame>& out) {
    StampedFrame frames[kBatch];
    const int count = udp_->receive_stamped(frames, kBatch);
    for (int i = 0; i < count; ++i) {
      if (repeats_.is_new(frames[i]))
        out.push_back({frames[i].arrival_us, index, cantools::Direction::kUnknown, frames[i].frame});
    }
  }

  void read_plain(int index, std::deque<ObservedFrame>& out) {
    CanFrame frames[kBatch];
    std::int64_t arrival_us[kBatch];
    const int count = other_->receive_timed(frames, arrival_us, kBatch);
    for (int i = 0; i < count; ++i)
      out.push_back({arrival_us[i], index, cantools::Direction::kUnknown, frames[i]});
  }

  std::unique_ptr<UdpBus> udp_;
  std::unique_ptr<CanBus> other_;
  cantools::RepeatFilter repeats_;
};

class LiveSource final : public FrameSource {
 public:
  explicit LiveSource(const std::vector<LiveBus>& buses) {
    for (const LiveBus& bus : buses) {
      listeners_.push_back(std::make_unique<Listener>(bus));
      buses_.push_back(bus.name);
    }
    utc_offset_us_ = utc_us() - monotonic_us();  // arrivals are on the monotonic clock
  }

  Read next(ObservedFrame& frame, int timeout_ms) override {
    if (ready_.empty()) {
      wait(timeout_ms);
      for (std::size_t i = 0; i < listeners_.size(); ++i) listeners_[i]->read(static_cast<int>(i), ready_);
    }
    if (ready_.empty()) return Read::kNothingYet;
    frame = ready_.front();
    ready_.pop_front();
    return Read::kFrame;
  }

  bool next_fd(cantools::ObservedFdFrame& out) override {
    for (std::size_t i = 0; i < listeners_.size(); ++i) {
      if (listeners_[i]->read_fd(&out.frame, 1) == 0) continue;
      out.time_us = monotonic_us();
      out.bus = static_cast<int>(i);
      return true;
    }
    return false;
  }

  std::string losses() const override {
    std::int64_t dropped = 0, malformed = 0;
    for (const auto& listener : listeners_) {
      dropped += listener->bus().counters().dropped;
      malformed += listener->bus().counters().malformed;
    }
    std::string text;
    if (dropped > 0) text = std::to_string(dropped) + " frames lost: this terminal or disk is too slow";
    if (malformed > 0)
      text += (text.empty() ? "" : "; ") + std::to_string(malformed) + " that are no classic 11-bit frames";
    return text;
  }

 private:
  void wait(int timeout_ms) {
    std::vector<pollfd> waits;
    bool all = true;
    for (const auto& listener : listeners_) {
      if (listener->bus().fd() < 0) all = false;
      waits.push_back({listener->bus().fd(), POLLIN, 0});
    }
    poll(waits.data(), waits.size(), all ? timeout_ms : std::min(timeout_ms, kNoDescriptor_ms));
  }

  std::vector<std::unique_ptr<Listener>> listeners_;
  std::deque<ObservedFrame> ready_;
};

}  // namespace

std::unique_ptr<FrameSource> open_live_source(const std::vector<LiveBus>& buses) {
  return std::make_unique<LiveSource>(buses);
}

}  // namespace sprung
