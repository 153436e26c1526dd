#include "tools/logs/recorder/network_tap.h"

#include <poll.h>

#include <array>
#include <stdexcept>

namespace sprung {

namespace {

/// LCM: no limit. Its default of 30 messages over all channels is why lcm-logger loses some under load
/// (facts L13).
constexpr int kUnlimited = 0;

}  // namespace

NetworkTap::NetworkTap(const std::string& lcm_url, const std::string& channels, MessageQueue& queue)
    : queue_(queue), lcm_(lcm_create(lcm_url.c_str())) {
  if (!lcm_)
    throw std::runtime_error("LCM could not start on '" + lcm_url +
                             "': check the address, or run 'sprung doctor'");
  lcm_subscription_t* const all = lcm_subscribe(lcm_.get(), channels.c_str(), &NetworkTap::on_message, this);
  if (all == nullptr)
    throw std::runtime_error("LCM does not take '" + channels + "' for channels: give a regular expression");
  lcm_subscription_set_queue_capacity(all, kUnlimited);
  thread_ = std::thread([this] { drain(); });
}

NetworkTap::~NetworkTap() { stop(); }

void NetworkTap::stop() {
  stopping_.signal();
  if (thread_.joinable()) thread_.join();
}

void NetworkTap::on_message(const lcm_recv_buf_t* buffer, const char* channel, void* user) noexcept {
  static_cast<NetworkTap*>(user)->queue_.push(buffer->recv_utime, channel, buffer->data, buffer->data_size);
}

void NetworkTap::drain() noexcept {
  constexpr int kNever = -1;
  std::array<pollfd, 2> waits{pollfd{lcm_get_fileno(lcm_.get()), POLLIN, 0},
                              pollfd{stopping_.fd(), POLLIN, 0}};
  bool stopping = false;
  while (true) {
    const int ready = poll(waits.data(), waits.size(), stopping ? 0 : kNever);
    if (ready > 0 && (waits[0].revents & POLLIN) != 0) {
      lcm_handle(lcm_.get());
    } else if (stopping) {
      return;
    }
    stopping = stopping || (waits[1].revents & POLLIN) != 0;
  }
}

}  // namespace sprung
