#pragma once
/// Takes every message off an LCM network in a thread of its own, as fast as they come, whatever the writer
/// does.
#include <string>
#include <thread>
#include <unordered_map>

#include "runtime/input_event.h"
#include "runtime/transport/lcm_receiver.h"
#include "signals/text_pattern.h"
#include "tools/logs/recorder/message_queue.h"

namespace sprung {

class NetworkTap {
 public:
  /// Receives from now on. @param channels regular expression for the whole name, as LCM's own
  /// subscriptions. @param queue outlives the tap.
  /// @throws std::invalid_argument for the address or the expression; std::runtime_error when the system
  /// refuses.
  NetworkTap(const std::string& lcm_url, const std::string& channels, MessageQueue& queue);
  ~NetworkTap();
  NetworkTap(const NetworkTap&) = delete;
  NetworkTap& operator=(const NetworkTap&) = delete;

  /// Takes what has arrived until now, then ends.
  void stop();

 private:
  void drain() noexcept;
  void take(const ReceivedMessage& message) noexcept;
  bool is_wanted(std::string_view channel);

  MessageQueue& queue_;
  const TextPattern channels_;
  std::unordered_map<std::string, bool> wanted_;  ///< what the expression says of channels seen before
  LcmReceiver receiver_;
  InputEvent stopping_;
  std::thread thread_;
};

}  // namespace sprung
