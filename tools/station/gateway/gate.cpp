#include "tools/station/gateway/gate.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "signals/messages.h"
#include "signals/mode_names.h"
#include "tools/station/gateway/file_parts.h"
#include "tools/station/gateway/message_bytes.h"

namespace sprung::gateway {
namespace {

/// Whoever knows an operator's public key can say hello in his name all day; each costs a signature's check.
constexpr double kHellosEachSecond = 20.0, kHellosAtOnce = 40.0;
/// From a command to the motion that it begins.
constexpr std::int64_t kBegins_us = 3'000'000;

bool is_motion(OperatorKind kind) noexcept {
  switch (kind) {
    case OperatorKind::kJump:
    case OperatorKind::kMoveJoint:
    case OperatorKind::kComply:
    case OperatorKind::kLand:
    case OperatorKind::kWalk:
      return true;
    default:
      return false;
  }
}

bool ends_by_itself(const OperatorCommand& command) noexcept {
  const bool goes_on = command.kind == OperatorKind::kWalk || command.kind == OperatorKind::kComply;
  return !goes_on || std::isfinite(command.hold_s);
}

/// Who drives or not: a stop, or a question.
bool moves_nothing(OperatorKind kind) noexcept {
  return kind == OperatorKind::kEstop || kind == OperatorKind::kStop || kind == OperatorKind::kReadParameter;
}

/// Said so often that it is no news for the audit log.
bool is_small_talk(OperatorKind kind) noexcept {
  return kind == OperatorKind::kHold || kind == OperatorKind::kEnable || kind == OperatorKind::kReadParameter;
}

std::string refusal_message(const OperatorCommand& command, const std::string& why, std::int64_t now_us) {
  sprung_msgs::operator_reply_t reply;
  reply.session = 0;  // the operator's own network has the robot's
  reply.utime = now_us;
  reply.seq = command.stamp.seq;
  reply.request_id = command.request_id;
  reply.took_effect_at_seq = -1;
  reply.outcome = static_cast<std::int8_t>(OperatorOutcome::kRefused);
  reply.parameter = 0;
  reply.parameter_value = kNaN;
  reply.answered_by = "operator-gateway";
  reply.reason = why;
  return message_text(channels::kOperatorReply, encoded(reply));
}

}  // namespace

Role role_for(OperatorKind kind) noexcept {
  switch (kind) {
    case OperatorKind::kEstop:
    case OperatorKind::kReadParameter:
    case OperatorKind::kNone:
      return Role::kWatch;
    case OperatorKind::kSetParameter:
    case OperatorKind::kHome:
    case OperatorKind::kMoveJoint:
    case OperatorKind::kEnable:
      return Role::kMaintain;
    default:
      return Role::kDrive;
  }
}

Gate::Gate(const SigningKey& own, std::vector<KnownOperator> operators)
    : own_(own), operators_(std::move(operators)), hellos_(kHellosEachSecond, kHellosAtOnce) {}

void Gate::know(std::vector<KnownOperator> operators) {
  operators_ = std::move(operators);
  for (auto& [id, session] : sessions_) {
    if (const KnownOperator* one = known(session.key)) session.role = one->role;
  }
  const KnownOperator* driver = nullptr;
  for (const KnownOperator& one : operators_)
    if (one.name == driver_ && one.revoked.empty()) driver = &one;
  if (driver == nullptr || driver->role < Role::kDrive) driver_.clear();
}

void Gate::robot_is_up(std::int64_t run, std::int64_t epoch_us) noexcept {
  run_ = run;
  epoch_us_ = epoch_us;
}

std::optional<Gate::Asked> Gate::decoded(const std::string& text) {
  sprung_msgs::operator_command_t message;
  const int size = static_cast<int>(text.size());
  Asked out;
  if (message.getEncodedSize() != size || message.decode(text.data(), 0, size) != size ||
      !from_message(message, out.command).good || out.command.kind == OperatorKind::kNone)
    return std::nullopt;
  out.run = message.session;
  return out;
}

const KnownOperator* Gate::known(const PublicKey& key) const {
  const auto found = std::find_if(operators_.begin(), operators_.end(),
                                  [&](const KnownOperator& one) { return one.key == key; });
  return found == operators_.end() ? nullptr : &*found;
}

Verdict Gate::turned(Turned why, std::string who) {
  ++counts_[why];
  Verdict out;
  out.turned = why;
  out.who = std::move(who);
  return out;
}

Verdict Gate::take(const Address& from, std::string_view packet, std::int64_t now_us, std::uint64_t session) {
  switch (kind_of(packet)) {
    case PacketKind::kHello:
      return hello(from, packet, now_us, session);
    case PacketKind::kSigned:
      return said(from, packet, now_us);
    default:
      return turned(Turned::kMalformed, "");
  }
}

/// A copy of a hello opens nothing for whoever sends it: he has not the half of the key that belongs to it.
Verdict Gate::hello(const Address& from, std::string_view packet, std::int64_t now_us,
                    std::uint64_t session) {
  const auto hello = read_hello(packet);
  if (!hello) return turned(Turned::kMalformed, "");
  const KnownOperator* const one = known(hello->operator_key);
  if (one == nullptr) return turned(Turned::kUnknown, "");
  if (!hellos_.take(now_us)) return turned(Turned::kTooMany, one->name);
  if (!hello_is_genuine(packet, hello->operator_key, own_.public_key()))
    return turned(Turned::kForged, one->name);
  Welcome welcome;
  welcome.nonce = hello->nonce;
  welcome.time_us = now_us;
  welcome.epoch_us = epoch_us_;
  if (!one->revoked.empty()) {
    welcome.refusal = "the key of " + one->name + " was revoked on " + one->revoked;
    Verdict out = turned(Turned::kRevoked, one->name);
    out.packets.push_back({from, welcome_packet(welcome, own_, one->key)});
    return out;
  }
  Verdict out;
  out.who = one->name;
  for (const auto& [id, open] : sessions_) {
    if (open.nonce != hello->nonce || open.key != hello->operator_key) continue;
    out.packets.push_back({from, open.welcome});  // the first one was lost
    return out;
  }
  const ExchangeKey exchange = ExchangeKey::make();
  make_room();
  try {
    Session made(Seal::of_robot(exchange, hello->exchange));
    made.key = one->key;
    made.name = one->name;
    made.role = one->role;
    made.address = from;
    made.hidden = hello->hidden;
    made.nonce = hello->nonce;
    made.heard_us = now_us;
    welcome.session = out.session = session;
    welcome.exchange = exchange.public_key();
    made.welcome = welcome_packet(welcome, own_, one->key);
    out.packets.push_back({from, made.welcome});
    sessions_.emplace(session, std::move(made));
  } catch (const std::runtime_error&) {
    return turned(Turned::kMalformed, one->name);
  }
  return out;
}

/// The oldest of those that never spoke goes first: they may be copies of hellos.
void Gate::make_room() {
  while (sessions_.size() >= kMostSessions) {
    const auto oldest = std::min_element(
        sessions_.begin(), sessions_.end(), [](const auto& a, const auto& b) {
          return std::pair(a.second.spoke, a.second.heard_us) < std::pair(b.second.spoke, b.second.heard_us);
        });
    sessions_.erase(oldest);
  }
}

Verdict Gate::said(const Address& from, std::string_view packet, std::int64_t now_us) {
  const auto said = read_said(packet);
  if (!said) return turned(Turned::kMalformed, "");
  const auto found = sessions_.find(said->session);
  if (found == sessions_.end()) return turned(Turned::kUnknown, "");
  Session& session = found->second;
  const KnownOperator* const one = known(session.key);
  if (one == nullptr || !one->revoked.empty()) return turned(Turned::kRevoked, session.name);
  if (!session.seen.is_new(said->number)) return turned(Turned::kReplayed, session.name);
  const std::int64_t age_us = now_us - said->time_us;
  if (said->time_us < 0 || age_us > kOldest_us || age_us < -kMostAhead_us)
    return turned(Turned::kLate, session.name);
  if (!said_is_genuine(packet, session.key)) return turned(Turned::kForged, session.name);
  session.seen.take(said->number);
  session.heard_us = now_us;
  session.spoke = true;
  if (session.name == driver_) driver_heard_us_ = now_us;
  session.address = from;  // a laptop that roams has another one
  if (said->kind == SaidKind::kCommand) return command(session, said->session, *said, now_us);
  if (!session.rate.take(now_us)) return turned(Turned::kTooMany, session.name);
  Verdict out;
  out.who = session.name;
  out.session = said->session;
  if (said->kind == SaidKind::kHandOver) return hand_over(session, said->text, now_us);
  if (said->kind == SaidKind::kFile) out.part_asked = said->text;
  if (said->kind == SaidKind::kBye) {
    left_ = left_ || session.name == mover_;
    sessions_.erase(found);
  }
  return out;
}

Turned Gate::may_say(const Session& session, const Asked& asked) const {
  const OperatorKind kind = asked.command.kind;
  if (run_ == 0 || (asked.run != run_ && kind != OperatorKind::kEstop)) return Turned::kOtherRun;
  if (session.role < role_for(kind)) return Turned::kRole;
  if (moves_nothing(kind)) return Turned::kNone;
  return driver_.empty() || driver_ == session.name ? Turned::kNone : Turned::kNotDriver;
}

Verdict Gate::refused_command(std::uint64_t id, const OperatorCommand& command, Turned why,
                              std::int64_t now_us) {
  const Session& session = sessions_.at(id);
  std::string reason = std::string("the robot hears too much of ") + session.name;
  if (why == Turned::kRole)
    reason = session.name + "'s key is to " + name(session.role) + ", and this takes one to " +
             name(role_for(command.kind));
  if (why == Turned::kNotDriver)
    reason = driver_ + " drives; he hands over by: sprung --via ROBOT hand-over " + session.name;
  if (why == Turned::kOtherRun)
    reason = run_ == 0 ? kNoRobot : "the robot was started anew: begin this command or page anew too";
  Verdict out = turned(why, session.name);
  out.session = id;
  if (auto packet = tell(id, ToldKind::kMessage, refusal_message(command, reason, now_us), now_us))
    out.packets.push_back(std::move(*packet));
  return out;
}

Verdict Gate::command(Session& session, std::uint64_t id, const Said& said, std::int64_t now_us) {
  const auto asked = decoded(said.text);
  if (!asked) return turned(Turned::kMalformed, session.name);
  const OperatorCommand* const command = &asked->command;
  if (is_ahead(*command, now_us)) return turned(Turned::kMalformed, session.name);
  if (is_over(*command)) return turned(Turned::kReplayed, session.name);
  const bool emergency = command->kind == OperatorKind::kEstop;
  if (!emergency && !session.rate.take(now_us))
    return refused_command(id, *command, Turned::kTooMany, now_us);
  const Turned why = may_say(session, *asked);
  if (why != Turned::kNone) return refused_command(id, *command, why, now_us);
  Verdict out;
  out.who = session.name;
  out.session = id;
  out.command = *command;
  const bool again = std::exchange(session.request, command->request_id) == command->request_id;
  if (!again && !is_small_talk(command->kind)) out.event = name(command->kind);
  if (!moves_nothing(command->kind)) {
    if (driver_.empty()) out.event += "; drives from now on";
    driver_ = session.name;
    driver_heard_us_ = now_us;
  }
  note_motion(session, *command, now_us);
  note_stop(*command);
  return out;
}

/// The robot executes none that is not newer than what it has forgotten: one of next week would be the last.
bool Gate::is_ahead(const OperatorCommand& command, std::int64_t now_us) const noexcept {
  constexpr std::int64_t kClocks_us = 10'000'000;
  return command.request_id > request_id_at(now_us - epoch_us_ + kClocks_us);
}

bool Gate::is_over(const OperatorCommand& command) const {
  return command.kind == OperatorKind::kEstop &&
         std::find(stops_over_.begin(), stops_over_.end(), command.request_id) != stops_over_.end();
}

void Gate::note_stop(const OperatorCommand& command) {
  if (command.kind == OperatorKind::kClear) {
    stops_over_.insert(stops_over_.end(), stops_.begin(), stops_.end());
    stops_.clear();
    if (stops_over_.size() > kRemembered)
      stops_over_.erase(stops_over_.begin(), stops_over_.end() - kRemembered);
  }
  if (command.kind != OperatorKind::kEstop) return;
  if (std::find(stops_.begin(), stops_.end(), command.request_id) != stops_.end()) return;
  stops_.push_back(command.request_id);
  if (stops_.size() > kRemembered) stops_.erase(stops_.begin());
}

void Gate::note_motion(const Session& session, const OperatorCommand& command, std::int64_t now_us) {
  if (!is_motion(command.kind)) return;
  mover_ = session.name;
  moved_us_ = now_us;
  ends_by_itself_ = ends_by_itself(command);
  left_ = false;
}

Verdict Gate::hand_over(Session& session, const std::string& to, std::int64_t now_us) {
  const auto heir = std::find_if(operators_.begin(), operators_.end(), [&](const KnownOperator& one) {
    return one.name == to && one.revoked.empty() && one.role >= Role::kDrive;
  });
  if (session.role < Role::kDrive || heir == operators_.end()) return turned(Turned::kRole, session.name);
  if (!driver_.empty() && driver_ != session.name) return turned(Turned::kNotDriver, session.name);
  driver_ = to;
  driver_heard_us_ = now_us;
  if (mover_ == session.name) mover_ = to;  // what moves is his now: while he is heard, it goes on
  Verdict out;
  out.who = session.name;
  out.event = "hands over to " + to;
  return out;
}

bool Gate::heard_of(const std::string& name, std::int64_t since_us) const {
  return std::any_of(sessions_.begin(), sessions_.end(), [&](const auto& row) {
    return row.second.name == name && row.second.spoke && row.second.heard_us >= since_us;
  });
}

bool Gate::link_is_lost(bool moves, std::int64_t now_us) {
  if (mover_.empty()) return false;
  if (!moves) {
    if (now_us - moved_us_ > kBegins_us) mover_.clear();
    return false;
  }
  if (left_ && ends_by_itself_) return false;
  return !heard_of(mover_, now_us - kLost_us);
}

std::vector<std::string> Gate::tidy(bool moves, std::int64_t now_us) {
  for (auto row = sessions_.begin(); row != sessions_.end();) {
    const KnownOperator* const one = known(row->second.key);
    const bool over = one == nullptr || !one->revoked.empty() || now_us - row->second.heard_us > kOver_us;
    row = over ? sessions_.erase(row) : std::next(row);
  }
  if (driver_.empty() || moves || now_us - driver_heard_us_ <= kOver_us) return {};
  return {std::exchange(driver_, "")};
}

std::vector<std::uint64_t> Gate::sessions() const {
  std::vector<std::uint64_t> out;
  for (const auto& [id, session] : sessions_)
    if (session.spoke) out.push_back(id);
  return out;
}

std::optional<std::pair<Address, std::string>> Gate::tell(std::uint64_t session, ToldKind kind,
                                                          std::string text, std::int64_t now_us) {
  const auto found = sessions_.find(session);
  if (found == sessions_.end() || text.size() > kLongestSealed) return std::nullopt;
  Session& to = found->second;
  const Told told{session, ++to.told, now_us, kind, std::move(text)};
  return std::pair(to.address, sealed_packet(told, to.seal, to.hidden));
}

std::string Gate::news(std::uint64_t session) const {
  const auto found = sessions_.find(session);
  nlohmann::ordered_json out{{"driver", driver_}};
  if (found != sessions_.end()) {
    out["you"] = found->second.name;
    out["role"] = name(found->second.role);
  }
  return out.dump();
}

}  // namespace sprung::gateway
