#include "tools/logs/recorder/network_tap.h"

#include <poll.h>

#include <array>
#include <utility>

#include "runtime/session_clock.h"

namespace sprung {

namespace {

/// Somebody who makes up names may not fill the memory.
constexpr std::size_t kMostChannels = 4096;
constexpr std::int64_t kLongestEnd_us = 1'000'000;

}  // namespace

NetworkTap::NetworkTap(const std::string& lcm_url, const std::string& channels, MessageQueue& queue)
    : queue_(queue), channels_(channels), receiver_(lcm_url, Fragments::kPutTogether) {
  thread_ = std::thread([this] { drain(); });
}

NetworkTap::~NetworkTap() { stop(); }

void NetworkTap::stop() {
  stopping_.signal();
  if (thread_.joinable()) thread_.join();
}

bool NetworkTap::is_wanted(std::string_view channel) {
  std::string name(channel);
  const auto seen = wanted_.find(name);
  if (seen != wanted_.end()) return seen->second;
  const bool wanted = channels_.matches(channel);
  if (wanted_.size() < kMostChannels) wanted_.emplace(std::move(name), wanted);
  return wanted;
}

void NetworkTap::take(const ReceivedMessage& message) noexcept {
  try {
    if (is_wanted(message.channel)) queue_.push(message.utc_us, message.channel, message.data, message.size);
  } catch (...) {
    return;  // a name that the expression cannot be held against, or no memory: the next one may fit
  }
}

void NetworkTap::drain() noexcept {
  constexpr int kNever = -1;
  const auto use = [this](const ReceivedMessage& message) { take(message); };
  std::array<pollfd, 2> waits{pollfd{receiver_.fd(), POLLIN, 0}, pollfd{stopping_.fd(), POLLIN, 0}};
  while ((waits[1].revents & POLLIN) == 0) {
    if (poll(waits.data(), waits.size(), kNever) > 0 && waits[0].revents != 0) receiver_.receive(use);
  }
  // What has arrived until now; somebody who goes on sending does not hold it up.
  const std::int64_t end_us = monotonic_us() + kLongestEnd_us;
  while (receiver_.receive(use) && monotonic_us() < end_us) continue;
}

}  // namespace sprung
