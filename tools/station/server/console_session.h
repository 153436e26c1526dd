#pragma once
/// The pages that are open, and what they ask of a robot: texts of pages and answers of the robot in; texts
/// to pages and OPERATOR_COMMANDs out. One page drives, the others watch; every page may stop the robot at
/// once. Pure; times are the session's us. The messages: docs/operator.md, "What pages and server say".
#include <cstdint>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "robots/robot_config.h"
#include "signals/operator.h"
#include "tools/station/server/command_table.h"
#include "tools/station/server/estop_repeater.h"
#include "tools/station/server/held_motion.h"
#include "tools/station/server/parameter_board.h"
#include "tools/station/server/request_desk.h"
#include "tools/station/server/steered_walk.h"
#include "tools/station/server/stick_lock.h"

namespace sprung::station {

struct SessionOptions {
  std::string preset;
  bool maintenance = false;  ///< the robot moves only while somebody holds: pages have a key for it
  std::uint64_t salt = 0;    ///< of request ids
};

/// What is to be done now, in this order.
struct Outbox {
  std::vector<OperatorCommand> commands;
  std::vector<std::pair<int, std::string>> texts;  ///< page and text
  std::vector<int> close;                          ///< pages that do not speak as they should
};

class ConsoleSession {
 public:
  static constexpr std::size_t kLongestText = 4096;
  static constexpr int kMostBadTexts = 20;
  /// [design choice] a page says something three times a second; one that does not is asleep, or its laptop
  /// is. What it held has ended long before. A busy browser stands still for two seconds when it first draws.
  static constexpr std::int64_t kAsleep_us = 5'000'000;

  ConsoleSession(const RobotConfig& robot, const SessionOptions& options);

  void page_opened(int page, std::int64_t now_us);
  void page_closed(int page, std::int64_t now_us);
  /// Anything that a page may send. What cannot be read is answered with an error.
  void text(int page, std::string_view text, std::int64_t now_us);
  void answer(const RobotAnswer& answer, std::int64_t now_us);
  /// What the newest DRIVE_STATE says. @param state_us its time.
  void drives(bool may_have_torque, std::int64_t state_us);
  void robot_is(RobotNow now) { robot_now_ = std::move(now); }

  /// To be called every 20 ms, after every text, and at next_step_us().
  Outbox step(std::int64_t now_us);
  /// When it must be called again at the latest: an emergency stop is said again in time.
  std::int64_t next_step_us() const noexcept { return estop_.next_us(); }

  int driver() const noexcept { return driver_; }  ///< page; -1: nobody
  /// Who drives, emergency stop, sticks: the part of `state` that is ours.
  nlohmann::ordered_json status_json(std::int64_t now_us);
  const std::vector<OperatorForm>& forms() const noexcept { return forms_; }
  const EstopRepeater& estop() const noexcept { return estop_; }

 private:
  struct Page {
    std::int64_t heard_us = 0;
    int bad_texts = 0;
    bool asleep = false;
    bool may_begin = false;  ///< nobody drove when it was opened: it drives once it speaks
  };
  void take(int page, const nlohmann::json& message, std::int64_t now_us);
  void request(int page, const nlohmann::json& message, std::int64_t now_us);
  void sticks(int page, const nlohmann::json& message, std::int64_t now_us);
  void hold(int page, bool held, std::int64_t now_us);
  void enable(int page, bool held, std::int64_t now_us);
  void press_estop(std::int64_t now_us);
  void drive(int page, const char* why, std::int64_t now_us);  ///< -1: nobody
  void let_go_of_all(std::int64_t now_us);
  void say_for_driver(const std::vector<OperatorCommand>& commands, std::int64_t now_us);
  void tell(const RequestNews& news);
  void send(int page, const nlohmann::ordered_json& message);
  void tell_estop();
  void tell_parameters(int page);
  void ask_parameter(std::int64_t now_us);
  void refuse(int page, std::int64_t number, const std::string& command, const std::string& why);
  bool demand_driver(int page) const;

  RobotConfig robot_;
  SessionOptions options_;
  std::vector<OperatorForm> forms_;
  RobotNow robot_now_;
  std::map<int, Page> pages_;
  int driver_ = -1;
  std::string driver_why_;
  ParameterBoard board_;
  RequestDesk desk_;
  EstopRepeater estop_;
  OperatorCommand estop_command_;
  StickLock lock_;
  std::string stick_source_;
  SteeredWalk steered_;
  HeldMotion held_;
  std::int64_t held_since_number_ = 0;  ///< of the request that began it
  bool enabling_ = false;               ///< maintenance: the driving page's key is held
  std::int64_t enabling_heard_us_ = 0;
  std::int64_t enable_us_ = 0;
  Outbox out_;
};

}  // namespace sprung::station
