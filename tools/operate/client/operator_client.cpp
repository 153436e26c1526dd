#include "tools/operate/client/operator_client.h"

#include <algorithm>
#include <random>

#include "lcmtypes/channels.h"
#include "runtime/stop_request.h"

namespace sprung {

namespace {

constexpr std::int64_t kSendAgain_us = 100'000;
constexpr std::int64_t kAskAgain_us = 500'000;

/// Later ones are greater, as lcmtypes/operator.lcm asks; of two operators in one microsecond, most probably.
std::int64_t new_id(std::int64_t now_us) {
  constexpr std::int64_t kEach_us = 1024;
  return now_us * kEach_us + static_cast<std::int64_t>(std::random_device()() % kEach_us);
}

bool ends(OperatorOutcome outcome) {
  return outcome != OperatorOutcome::kAccepted && outcome != OperatorOutcome::kQueued;
}

}  // namespace

OperatorClient::OperatorClient(const RunInfo& info)
    : node_(commanding(info)), commands_(node_.publisher<OperatorCommand>(channels::kOperatorCommand)) {
  node_.subscribe_message(channels::kOperatorReply, CountLimits::none(), replies_);
  node_.start();
}

std::optional<OperatorAnswer> OperatorClient::next_answer(std::int64_t request_id) {
  while (const auto reply = replies_.pop()) {
    if (reply->request_id == request_id) {
      return OperatorAnswer{static_cast<OperatorOutcome>(reply->outcome),
                            reply->took_effect_at_seq,
                            reply->answered_by,
                            reply->reason,
                            reply->parameter,
                            reply->parameter_value};
    }
  }
  return std::nullopt;
}

/// Each time with its own time: what comes again as it was is refused as a replay.
void OperatorClient::publish(OperatorCommand command) {
  command.stamp.utime_us = node_.utime_us();
  commands_.publish(command);
}

std::optional<OperatorAnswer> OperatorClient::send(OperatorCommand& command, double timeout_s) {
  if (command.request_id == 0) {
    command.request_id = new_id(node_.utime_us());
  }
  const std::int64_t end_us = node_.utime_us() + static_cast<std::int64_t>(timeout_s * 1e6);
  std::int64_t send_us = 0;
  while (node_.utime_us() < end_us && !stop_requested()) {
    if (node_.utime_us() >= send_us) {
      publish(command);
      send_us = node_.utime_us() + kSendAgain_us;
    }
    if (auto answer = next_answer(command.request_id)) {
      next_ask_us_ = node_.utime_us() + kAskAgain_us;
      return answer;
    }
    node_.wait_for_input(std::min(send_us, end_us));
  }
  return std::nullopt;
}

std::optional<OperatorAnswer> OperatorClient::wait_done(const OperatorCommand& command, double timeout_s) {
  const auto timeout_us = static_cast<std::int64_t>(timeout_s * 1e6);
  std::int64_t end_us = node_.utime_us() + timeout_us;
  while (node_.utime_us() < end_us && !stop_requested()) {
    if (auto answer = next_answer(command.request_id)) {
      if (ends(answer->outcome)) {
        return answer;
      }
      end_us = node_.utime_us() + timeout_us;  // it is alive and at work
      continue;
    }
    if (node_.utime_us() >= next_ask_us_) {
      publish(command);
      next_ask_us_ = node_.utime_us() + kAskAgain_us;
    }
    node_.wait_for_input(std::min(next_ask_us_, end_us));
  }
  return std::nullopt;
}

}  // namespace sprung
