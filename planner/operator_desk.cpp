#include "planner/operator_desk.h"

#include <algorithm>

namespace sprung {
namespace {

constexpr const char* kForgotten = "asked too long ago: request ids grow with time, and 256 came since";

}  // namespace

bool OperatorDesk::submit(const OperatorCommand& command) noexcept {
  if (const Answered* known = find(command.request_id)) {
    if (known->answered) push(known->reply);
    return true;
  }
  if (command.request_id <= forgotten_) {
    reply(command.request_id, OperatorOutcome::kRefused, kForgotten, {});
    return true;
  }
  if (waiting_count_ == kMostWaiting) return false;
  waiting_[waiting_count_++] = command;
  remember(command.request_id);
  return true;
}

bool OperatorDesk::take_due(std::int64_t seq, OperatorCommand& out) noexcept {
  for (int i = 0; i < waiting_count_; ++i) {
    if (waiting_[i].apply_at_seq > seq) continue;
    take(i, out);
    return true;
  }
  return false;
}

bool OperatorDesk::take_any(OperatorCommand& out) noexcept {
  if (waiting_count_ == 0) return false;
  take(0, out);
  return true;
}

void OperatorDesk::take(int index, OperatorCommand& out) noexcept {
  out = waiting_[index];
  std::copy(waiting_.begin() + index + 1, waiting_.begin() + waiting_count_, waiting_.begin() + index);
  --waiting_count_;
}

void OperatorDesk::reply(std::int64_t request_id, OperatorOutcome outcome, const char* reason,
                         const Stamp& now, const ParameterNews& news) noexcept {
  OperatorReply out;
  out.parameter = news.parameter;
  out.parameter_value = news.value;
  out.stamp = now;
  out.request_id = request_id;
  out.outcome = outcome;
  out.answered_by = "sprung-motion-planner";
  out.reason = reason;
  Answered* known = find(request_id);
  const bool took_effect_before = known != nullptr && known->answered;
  if (outcome == OperatorOutcome::kAccepted) out.took_effect_at_seq = now.seq;
  if (outcome != OperatorOutcome::kRefused && took_effect_before) {
    out.took_effect_at_seq = known->reply.took_effect_at_seq;
  }
  if (known != nullptr) {
    known->reply = out;
    known->answered = true;
  }
  push(out);
}

bool OperatorDesk::next_reply(OperatorReply& out) noexcept {
  if (reply_count_ == 0) return false;
  out = replies_[first_reply_];
  first_reply_ = (first_reply_ + 1) % kMostReplies;
  --reply_count_;
  return true;
}

OperatorDesk::Answered* OperatorDesk::find(std::int64_t request_id) noexcept {
  auto* entry = std::find_if(memory_.begin(), memory_.end(),
                             [&](const Answered& a) { return a.used && a.reply.request_id == request_id; });
  return entry == memory_.end() ? nullptr : entry;
}

void OperatorDesk::remember(std::int64_t request_id) noexcept {
  Answered& entry = memory_[next_memory_];
  next_memory_ = (next_memory_ + 1) % kRemembered;
  if (entry.used) forgotten_ = std::max(forgotten_, entry.reply.request_id);
  entry = Answered{};
  entry.used = true;
  entry.reply.request_id = request_id;
}

/// The shell takes all replies in every cycle; if it does not, the oldest are of no use to anyone.
void OperatorDesk::push(const OperatorReply& reply) noexcept {
  if (reply_count_ == kMostReplies) {
    first_reply_ = (first_reply_ + 1) % kMostReplies;
    --reply_count_;
  }
  replies_[(first_reply_ + reply_count_) % kMostReplies] = reply;
  ++reply_count_;
}

}  // namespace sprung
