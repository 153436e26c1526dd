#include "tools/station/server/request_desk.h"

#include <algorithm>

#include "tools/station/server/held_motion.h"

namespace sprung::station {
namespace {

bool is_over(OperatorOutcome outcome) noexcept {
  return outcome != OperatorOutcome::kAccepted && outcome != OperatorOutcome::kQueued;
}

bool is_stop(OperatorKind kind) noexcept {
  return kind == OperatorKind::kStop || kind == OperatorKind::kSit || kind == OperatorKind::kEstop;
}

bool ends_motion(const OperatorCommand& command) noexcept {
  return is_stop(command.kind) ||
         (command.kind == OperatorKind::kHold && command.hold_s <= HeldMotion::kLetGo_s);
}

bool is_said_once(OperatorKind kind) noexcept {
  return kind == OperatorKind::kHold || kind == OperatorKind::kEnable;
}

bool is_made_void(OperatorKind kind, const OperatorCommand& command) noexcept {
  const OperatorKind by = command.kind;
  const bool walk = by == OperatorKind::kWalk && kind == OperatorKind::kHold;
  const bool renewed = kind == by && (by == OperatorKind::kWalk || by == OperatorKind::kHold ||
                                      by == OperatorKind::kEnable);
  const bool moves = !is_stop(kind) && kind != OperatorKind::kClear && kind != OperatorKind::kHome;
  return walk || renewed || (ends_motion(command) && moves);
}

const char* who_is_silent(OperatorKind kind) noexcept {
  const bool bridges = kind == OperatorKind::kEstop || kind == OperatorKind::kClear ||
                       kind == OperatorKind::kHome;
  return bridges ? "the drive bridge does not answer; if in doubt press the hardware emergency stop"
                 : "the motion planner does not answer; see its line under processes";
}

}  // namespace

/// Later ones are greater, as lcmtypes/operator.lcm asks.
std::int64_t RequestDesk::next_id(std::int64_t now_us) noexcept {
  constexpr std::int64_t kEach_us = 1024;
  const std::int64_t wished = now_us * kEach_us + static_cast<std::int64_t>(salt_ % kEach_us);
  last_id_ = std::max(wished, last_id_ + 1);
  return last_id_;
}

std::optional<std::int64_t> RequestDesk::add(OperatorCommand command, const Asker& asker,
                                             std::int64_t now_us) {
  drop_what_is_void(command);
  if (requests_.size() >= kMost && command.kind != OperatorKind::kEstop) return std::nullopt;
  command.request_id = next_id(now_us);
  requests_.push_back({command, asker, false, now_us, now_us + kFirstAnswer_us, ""});
  return command.request_id;
}

void RequestDesk::drop_what_is_void(const OperatorCommand& by) {
  const auto is_void = [&by](const Request& request) {
    return !request.answered && is_made_void(request.command.kind, by);
  };
  for (const Request& request : requests_) {
    if (!is_void(request)) continue;
    const std::string why = std::string("not said any more: ") + name(by.kind) + " came after it";
    dropped_.push_back({request.asker, request.command.kind, "refused", why, -1, true});
  }
  requests_.erase(std::remove_if(requests_.begin(), requests_.end(), is_void), requests_.end());
}

std::optional<RequestNews> RequestDesk::answer(const RobotAnswer& answer, std::int64_t now_us) {
  const auto request = std::find_if(requests_.begin(), requests_.end(), [&](const Request& r) {
    return r.command.request_id == answer.request_id;
  });
  if (request == requests_.end()) return std::nullopt;
  request->answered = true;
  request->give_up_us = now_us + kSilence_us;
  request->send_us = now_us + kAskAgain_us;
  const RequestNews news{request->asker, request->command.kind, name(answer.outcome),
                         answer.reason,  answer.cycle,          is_over(answer.outcome)};
  const bool again = request->told == news.outcome;
  request->told = news.outcome;
  if (news.over) requests_.erase(request);
  return again ? std::nullopt : std::optional<RequestNews>(news);
}

void RequestDesk::step(std::int64_t now_us, std::vector<OperatorCommand>& send,
                       std::vector<RequestNews>& news) {
  news.insert(news.end(), dropped_.begin(), dropped_.end());
  dropped_.clear();
  for (Request& request : requests_) {
    const OperatorKind kind = request.command.kind;
    if (now_us >= request.give_up_us)
      news.push_back({request.asker, kind, "no answer", who_is_silent(kind), -1, true});
    else if (now_us >= request.send_us) {
      send.push_back(request.command);
      const std::int64_t again_us = request.answered ? kAskAgain_us : kSayAgain_us;
      request.send_us = is_said_once(kind) ? request.give_up_us : now_us + again_us;
    }
  }
  requests_.erase(std::remove_if(requests_.begin(), requests_.end(),
                                 [now_us](const Request& r) { return now_us >= r.give_up_us; }),
                  requests_.end());
}

}  // namespace sprung::station
