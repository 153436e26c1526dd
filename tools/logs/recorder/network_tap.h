#pragma once
/// Takes every message off an LCM network in a thread of its own, as fast as they come, whatever the writer
/// does.
#include <lcm/lcm.h>

#include <memory>
#include <string>
#include <thread>

#include "runtime/input_event.h"
#include "tools/logs/recorder/message_queue.h"

namespace sprung {

class NetworkTap {
 public:
  /// Receives from now on. @param channels regular expression, as LCM's own subscriptions. @param queue
  /// outlives the tap.
  /// @throws std::runtime_error when LCM cannot start or does not take the expression.
  NetworkTap(const std::string& lcm_url, const std::string& channels, MessageQueue& queue);
  ~NetworkTap();
  NetworkTap(const NetworkTap&) = delete;
  NetworkTap& operator=(const NetworkTap&) = delete;

  /// Takes what has arrived until now, then ends.
  void stop();

 private:
  static void on_message(const lcm_recv_buf_t* buffer, const char* channel, void* user) noexcept;
  void drain() noexcept;

  struct LcmDeleter {
    void operator()(lcm_t* lcm) const noexcept { lcm_destroy(lcm); }
  };
  MessageQueue& queue_;
  std::unique_ptr<lcm_t, LcmDeleter> lcm_;
  InputEvent stopping_;
  std::thread thread_;
};

}  // namespace sprung
