#include "tools/station/server/console_session.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

namespace sprung::station {
namespace {

using Json = nlohmann::json;
using Ordered = nlohmann::ordered_json;

constexpr const char* kWatches =
    "this page watches and does not drive: take the controls first (the emergency stop works from every "
    "page)";
constexpr std::int64_t kEnableRenew_us = 100'000;
constexpr std::int64_t kEnableGone_us = 500'000;

std::string text_of(const Json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end() || !found->is_string())
    throw std::invalid_argument(std::string("'") + key + "' must be a text");
  return found->get<std::string>();
}

bool flag_of(const Json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end() || !found->is_boolean())
    throw std::invalid_argument(std::string("'") + key + "' must be true or false");
  return found->get<bool>();
}

double number_of(const Json& message, const char* key) {
  const auto found = message.find(key);
  if (found == message.end() || !found->is_number())
    throw std::invalid_argument(std::string("'") + key + "' must be a number");
  return found->get<double>();
}

std::int64_t id_of(const Json& message) {
  const auto found = message.find("id");
  if (found == message.end() || !found->is_number_integer())
    throw std::invalid_argument("'id' must be a whole number");
  return found->get<std::int64_t>();
}

}  // namespace

ConsoleSession::ConsoleSession(const RobotConfig& robot, const SessionOptions& options)
    : robot_(robot),
      options_(options),
      forms_(operator_forms(robot_, options.preset)),
      board_(robot_, options.preset),
      desk_(options.salt),
      steered_(robot_.gaits) {}

void ConsoleSession::send(int page, const Ordered& message) {
  // A text of a page comes back in it: what is no UTF-8 is replaced, never thrown.
  out_.texts.emplace_back(page, message.dump(-1, ' ', false, Ordered::error_handler_t::replace));
}

void ConsoleSession::refuse(int page, std::int64_t number, const std::string& command,
                            const std::string& why) {
  send(page, {{"type", "reply"},
              {"id", number},
              {"command", command},
              {"outcome", "refused"},
              {"reason", why},
              {"cycle", -1},
              {"over", true}});
}

bool ConsoleSession::demand_driver(int page) const { return page == driver_; }

void ConsoleSession::page_opened(int page, std::int64_t now_us) {
  pages_[page] = {now_us, 0, false, driver_ < 0};
  send(page, {{"type", "hello"},
              {"page", page},
              {"commands", forms_json(forms_)},
              {"parameters", board_.table_json()}});
  send(page, {{"type", "role"}, {"driver", driver_}, {"why", driver_why_}});
  tell_parameters(page);
  board_.ask_anew();
}

void ConsoleSession::page_closed(int page, std::int64_t now_us) {
  pages_.erase(page);
  if (page == driver_) drive(-1, "the page that drove was closed", now_us);
}

void ConsoleSession::drive(int page, const char* why, std::int64_t now_us) {
  let_go_of_all(now_us);
  driver_ = page;
  driver_why_ = why;
  for (const auto& [each, unused] : pages_)
    send(each, {{"type", "role"}, {"driver", driver_}, {"why", driver_why_}});
}

void ConsoleSession::let_go_of_all(std::int64_t now_us) {
  held_.let_go(now_us);
  lock_.lock("let go of sticks and dead-man first");
  enabling_ = false;
}

void ConsoleSession::text(int page, std::string_view text, std::int64_t now_us) {
  const auto known = pages_.find(page);
  if (known == pages_.end()) return;
  known->second.heard_us = now_us;
  known->second.asleep = false;
  try {
    if (text.size() > kLongestText) throw std::invalid_argument("a message has 4096 bytes at most");
    const Json message = Json::parse(text);
    if (!message.is_object()) throw std::invalid_argument("a message is an object");
    if (std::exchange(known->second.may_begin, false) && driver_ < 0)
      drive(page, "it was opened while nobody drove", now_us);
    take(page, message, now_us);
  } catch (const std::exception& error) {
    send(page, {{"type", "error"}, {"text", std::string(error.what()).substr(0, 200)}});
    if (++pages_[page].bad_texts == kMostBadTexts) out_.close.push_back(page);
  }
}

void ConsoleSession::take(int page, const Json& message, std::int64_t now_us) {
  const std::string type = text_of(message, "type");
  if (type == "alive") return;
  if (type == "estop") return press_estop(now_us);
  if (type == "take_over") return drive(page, "it took the controls", now_us);
  if (type == "request") return request(page, message, now_us);
  if (type == "sticks") return sticks(page, message, now_us);
  if (type == "hold") return hold(page, flag_of(message, "held"), now_us);
  if (type == "enable") return enable(page, flag_of(message, "held"), now_us);
  throw std::invalid_argument("no message is called '" + type.substr(0, 40) + "'");
}

/// Never refused, whoever says it, and in front of everything else.
void ConsoleSession::press_estop(std::int64_t now_us) {
  if (!estop_.press(now_us)) return;
  let_go_of_all(now_us);
  held_.forget();
  steered_.ended();
  OperatorCommand command;
  command.kind = OperatorKind::kEstop;
  const auto id = desk_.add(command, {}, now_us);
  command.request_id = *id;
  estop_command_ = command;
  tell_estop();
}

void ConsoleSession::tell_estop() {
  const std::int64_t took_us = estop_.confirmed_us() - estop_.pressed_us();
  Ordered message{{"type", "estop"}, {"state", name(estop_.state())}};
  if (estop_.state() == EstopState::kConfirmed) {
    message["for_ms"] = 1e-3 * static_cast<double>(took_us);
    message["time_s"] = 1e-6 * static_cast<double>(estop_.confirmed_us());
  }
  for (const auto& [page, unused] : pages_) send(page, message);
}

void ConsoleSession::tell_parameters(int page) {
  send(page, {{"type", "parameters"}, {"values", board_.values_json()}});
}

/// One at a time: each answer says where to go on.
void ConsoleSession::ask_parameter(std::int64_t now_us) {
  const auto question = board_.question();
  if (!question) return;
  if (const auto id = desk_.add(*question, {}, now_us)) board_.asked(*id);
}

void ConsoleSession::request(int page, const Json& message, std::int64_t now_us) {
  const std::int64_t number = id_of(message);
  const std::string command_name = text_of(message, "command").substr(0, 40);
  if (!demand_driver(page)) return refuse(page, number, command_name, kWatches);
  try {
    const OperatorForm& form = form_named(forms_, command_name);
    const auto parameters = message.find("parameters");
    OperatorCommand command = command_of(form, robot_, robot_now_,
                                         parameters == message.end() ? Json::object() : *parameters);
    if (form.held) command.hold_s = HeldMotion::kHold_s;
    if (!desk_.add(command, {page, number}, now_us))
      return refuse(page, number, command_name, "too many commands are under way");
    const bool ends = command.kind == OperatorKind::kStop || command.kind == OperatorKind::kSit;
    if (ends) steered_.ended();
    if (ends) held_.forget();
    if (form.held) {
      held_.begin(now_us);
      held_since_number_ = number;
    }
  } catch (const std::invalid_argument& error) {
    refuse(page, number, command_name, error.what());
  }
}

void ConsoleSession::sticks(int page, const Json& message, std::int64_t now_us) {
  if (!demand_driver(page)) return;
  const std::string source = text_of(message, "source").substr(0, 80);
  if (source != stick_source_) lock_.lock("another device; let go of sticks and dead-man first");
  stick_source_ = source;
  if (const auto gait = message.find("gait"); gait != message.end() && gait->is_number_integer())
    steered_.use_gait(gait->get<int>());
  lock_.input({{number_of(message, "forward"), number_of(message, "left"), number_of(message, "turning")},
               flag_of(message, "dead_man")},
              now_us);
}

void ConsoleSession::hold(int page, bool held, std::int64_t now_us) {
  if (!demand_driver(page)) return;
  if (held) return held_.touch(now_us);
  held_.let_go(now_us);
}

void ConsoleSession::enable(int page, bool held, std::int64_t now_us) {
  if (!demand_driver(page) || !options_.maintenance) return;
  enabling_ = held;
  enabling_heard_us_ = now_us;
}

void ConsoleSession::answer(const RobotAnswer& answer, std::int64_t now_us) {
  if (board_.take(answer))
    for (const auto& [page, unused] : pages_) tell_parameters(page);
  const auto news = desk_.answer(answer, now_us);
  if (news) tell(*news);
}

void ConsoleSession::tell(const RequestNews& news) {
  if (news.kind == OperatorKind::kReadParameter && !news.went_well()) board_.give_up();
  const bool walk_or_hold = news.kind == OperatorKind::kWalk || news.kind == OperatorKind::kHold;
  if (news.asker.page < 0) {
    if (!news.went_well() && walk_or_hold && news.reason.rfind("not said any more", 0) != 0) {
      if (steered_.active() && news.kind == OperatorKind::kWalk)
        send(driver_, {{"type", "error"}, {"text", "walk: " + news.reason}});
      if (steered_.active()) steered_.ended();
      if (held_.active()) held_.forget();
    }
    return;
  }
  if (!news.went_well() && held_.active() && news.asker.number == held_since_number_) held_.forget();
  if (pages_.count(news.asker.page) == 0) return;
  send(news.asker.page, {{"type", "reply"},
                         {"id", news.asker.number},
                         {"command", name(news.kind)},
                         {"outcome", news.outcome},
                         {"reason", news.reason},
                         {"cycle", news.cycle},
                         {"over", news.over}});
}

void ConsoleSession::drives(bool may_have_torque, std::int64_t state_us) {
  if (estop_.drives(may_have_torque, state_us)) tell_estop();
}

void ConsoleSession::say_for_driver(const std::vector<OperatorCommand>& commands, std::int64_t now_us) {
  for (const OperatorCommand& command : commands) desk_.add(command, {}, now_us);
}

Outbox ConsoleSession::step(std::int64_t now_us) {
  for (auto& [page, each] : pages_) {
    if (each.asleep || now_us - each.heard_us <= kAsleep_us) continue;
    each.asleep = true;
    if (page == driver_) drive(-1, "nothing was heard of the page that drove", now_us);
  }
  std::vector<OperatorCommand> say;
  steered_.step(lock_.state(now_us), lock_.values(), now_us, say);
  held_.step(now_us, say);
  if (enabling_ && now_us - enabling_heard_us_ > kEnableGone_us) enabling_ = false;
  if (enabling_ && now_us >= enable_us_) {
    OperatorCommand enable;
    enable.kind = OperatorKind::kEnable;
    enable.hold_s = HeldMotion::kHold_s;
    say.push_back(enable);
    enable_us_ = now_us + kEnableRenew_us;
  }
  say_for_driver(say, now_us);
  ask_parameter(now_us);
  std::vector<RequestNews> news;
  desk_.step(now_us, say = {}, news);
  // The emergency stop goes first, and as often as it likes.
  if (estop_.due(now_us)) out_.commands.push_back(estop_command_);
  for (const OperatorCommand& each : say)
    if (each.kind != OperatorKind::kEstop) out_.commands.push_back(each);
  for (const RequestNews& each : news) tell(each);
  return std::exchange(out_, {});
}

Ordered ConsoleSession::status_json(std::int64_t now_us) {
  const StickState sticks = lock_.state(now_us);
  const EstopState estop = estop_.state();
  Ordered out{
      {"driver", driver_},
      {"driver_why", driver_why_},
      {"pages", pages_.size()},
      {"estop", {{"state", name(estop)}}},
      {"sticks",
       {{"state", name(sticks)},
        {"source", stick_source_},
        {"why", lock_.why_locked()},
        {"gait", steered_.gait() < 0 ? Ordered(nullptr) : Ordered(robot_.gaits[steered_.gait()].name)},
        {"speed", steered_.speed(lock_.values())}}},
      {"held", held_.active()},
      {"enabling", enabling_}};
  if (estop != EstopState::kNone)
    out["estop"]["for_ms"] = 1e-3 * static_cast<double>(
                                        (estop == EstopState::kConfirmed ? estop_.confirmed_us() : now_us) -
                                        estop_.pressed_us());
  return out;
}

}  // namespace sprung::station
