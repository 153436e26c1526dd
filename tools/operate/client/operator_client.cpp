#include "tools/operate/client/operator_client.h"

#include <algorithm>
#include <random>

#include "lcmtypes/channels.h"
#include "runtime/stop_request.h"

namespace sprung {

namespace {

constexpr std::int64_t kSendAgain_us = 100'000;
constexpr std::int64_t kAskAgain_us = 500'000;
constexpr std::size_t kMostRenewals = 64;  // more than are said while one may still be answered

/// Later ones are greater, as lcmtypes/operator.lcm asks; of two operators in one microsecond, most probably.
std::int64_t new_id(std::int64_t now_us) {
  constexpr std::int64_t kEach_us = 1024;
  return now_us * kEach_us + static_cast<std::int64_t>(std::random_device()() % kEach_us);
}

bool ends(OperatorOutcome outcome) {
  return outcome != OperatorOutcome::kAccepted && outcome != OperatorOutcome::kQueued;
}

OperatorAnswer answer_of(const sprung_msgs::operator_reply_t& reply) {
  return {static_cast<OperatorOutcome>(reply.outcome),
          reply.took_effect_at_seq,
          reply.answered_by,
          reply.reason,
          reply.parameter,
          reply.parameter_value};
}

}  // namespace

OperatorClient::OperatorClient(const RunInfo& info) : OperatorClient(commanding(info)) {}

OperatorClient::OperatorClient(const NodeOptions& options)
    : node_(options), commands_(node_.publisher<OperatorCommand>(channels::kOperatorCommand)) {
  node_.subscribe_message(channels::kOperatorReply, CountLimits::none(), replies_);
  node_.start();
}

std::optional<OperatorAnswer> OperatorClient::next_answer(std::int64_t request_id) {
  while (const auto reply = replies_.pop()) {
    if (reply->request_id == request_id) return answer_of(*reply);
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
    wait_until(std::min(send_us, end_us));
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
    wait_until(std::min(next_ask_us_, end_us));
  }
  return std::nullopt;
}

void OperatorClient::renew(const OperatorCommand& renewal, double each_s) {
  renewal_ = renewal;
  renew_each_us_ = static_cast<std::int64_t>(each_s * 1e6);
  next_renewal_us_ = 0;
  renewed_.clear();
}

void OperatorClient::say_renewal() {
  if (!renewal_ || node_.utime_us() < next_renewal_us_) return;
  next_renewal_us_ = node_.utime_us() + renew_each_us_;
  renewal_->request_id = new_id(node_.utime_us());
  renewed_.push_back(renewal_->request_id);
  if (renewed_.size() > kMostRenewals) renewed_.pop_front();
  publish(*renewal_);
}

void OperatorClient::wait_until(std::int64_t time_us) {
  say_renewal();
  node_.wait_for_input(renewal_ ? std::min(time_us, next_renewal_us_) : time_us);
}

std::optional<OperatorAnswer> OperatorClient::next_renewal_answer() {
  while (const auto reply = replies_.pop())
    if (std::find(renewed_.begin(), renewed_.end(), reply->request_id) != renewed_.end())
      return answer_of(*reply);
  return std::nullopt;
}

std::optional<OperatorAnswer> OperatorClient::wait_refused(double timeout_s) {
  const auto timeout_us = static_cast<std::int64_t>(timeout_s * 1e6);
  std::optional<OperatorAnswer> last;
  for (std::int64_t end_us = node_.utime_us() + timeout_us; !stop_requested();) {
    if (node_.utime_us() >= end_us) return std::nullopt;
    while (auto answer = next_renewal_answer()) {
      if (answer->outcome == OperatorOutcome::kRefused) return answer;
      last = std::move(answer);
      end_us = node_.utime_us() + timeout_us;
    }
    wait_until(end_us);
  }
  return last;
}

}  // namespace sprung
