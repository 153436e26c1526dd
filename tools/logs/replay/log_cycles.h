#pragma once
/// A log, cycle by cycle: what belongs to one cycle comes together, however its messages were mixed in the
/// file. Pure: events in, cycles out. Keeps a window of cycles, so a log of any length needs little memory.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "signals/enumeration.h"
#include "tools/logs/log/event.h"
#include "tools/logs/log/went_on.h"

namespace sprung {

using Bytes = std::vector<std::uint8_t>;

/// The cores that can be replayed.
enum class Core : std::int8_t { kEstimator = 0, kPlanner = 1, kController = 2 };
constexpr auto words_of(Core) {
  using E = Core;
  return words<E>({{E::kEstimator, "estimator"}, {E::kPlanner, "planner"}, {E::kController, "controller"}});
}
inline constexpr std::size_t kCores = kWords<Core>.size();
static_assert(is_dense<Core>(), "a core's value is its place in lists of kCores");

/// One cycle's messages as they are in the log, first of several; empty = the log has none.
struct LoggedCycle {
  std::int64_t seq = -1;
  std::int64_t time_us = 0;  ///< UTC, when the first of them was received
  double time_s = 0.0;       ///< robot's time of that, since the begin of the log
  bool alone = false;        ///< lock-step: the bridge went on without an answer of drives or controller
  bool anew = false;         ///< another session, or the bridge counts from 0 again: every core began fresh
  std::array<bool, kCores> restarted{};  ///< this core's process was started again before it made this cycle
  Bytes drive_state;
  Bytes imu;
  Bytes joint_state;
  Bytes leg_command;
  Bytes motion_state;
  Bytes drive_command;
  std::vector<Bytes> operator_commands;  ///< that the planner had before it made this cycle, in order
  std::vector<Bytes> replies;            ///< of the planner, made in this cycle

  bool empty() const noexcept;
  bool answered() const noexcept;  ///< some core made something in it
  void clear() noexcept;           ///< keeps the memory
};

/// What the log itself lacks, for the one who reads the result.
struct LogFlaws {
  std::int64_t late = 0;        ///< messages of cycles that were done with
  std::int64_t foreign = 0;     ///< too short for a message of ours, or of a cycle that cannot be
  std::int64_t unanswered = 0;  ///< operator's commands of whose cycle the log says nothing: they take effect
                                ///< where they stand in the log
  std::vector<std::string> said;  ///< by processes of lock-step runs that are not deterministic (went_on.h)
};

class LogCycles {
 public:
  using Use = std::function<void(LoggedCycle&)>;
  /// @param use gets each cycle once, in order of seq within one run of the bridge; may keep it by leaving
  /// another one, whose memory is used.
  explicit LogCycles(Use use);

  /// @param time_s robot's time of the event since the begin of the log (tools/logs/log/timeline.h).
  void add(const log::Event& event, double time_s);
  /// Whether add() makes anything of a channel.
  static bool uses(std::string_view channel) noexcept;
  void finish();  ///< hands out what the window still holds
  const LogFlaws& flaws() const noexcept { return flaws_; }

 private:
  static constexpr std::int64_t kWindow = 256;  ///< cycles that a message may be late by

  /// Session and request id: another `sprung up` may use the same id, and several may be on one network.
  using Request = std::pair<std::int64_t, std::int64_t>;
  struct WaitingCommand {
    Request request;
    std::int64_t apply_at_seq;
    /// First cycle that the planner had not made when it came, by the order of the log.
    std::int64_t from_seq;
    Bytes bytes;
  };
  LoggedCycle* cycle_of(std::int64_t seq);
  LoggedCycle& slot(std::int64_t seq) { return window_[seq % kWindow]; }
  void advance_to(std::int64_t seq);
  void hand_out(std::int64_t seq);
  void restart();
  void take_session(std::int64_t session);
  void add_cyclic(Bytes LoggedCycle::*member, const log::Event& event, double time_s);
  void add_status(const log::Event& event);
  void add_safety(const log::Event& event);
  void add_command(const log::Event& event);
  void add_reply(const log::Event& event);
  void give_commands(LoggedCycle& cycle);

  Use use_;
  std::vector<LoggedCycle> window_;
  std::int64_t newest_ = -1;  ///< the window holds newest_ - kWindow + 1 .. newest_
  std::int64_t handed_out_ = -1;
  std::int64_t session_ = 0;  ///< of the cycles
  log::WentOn went_on_;       ///< in that session
  bool begun_ = false;
  bool anew_ = false;
  std::array<bool, kCores> restarted_{};
  std::map<std::pair<std::int64_t, std::string>, std::int64_t> pids_;  ///< by session and process
  std::vector<WaitingCommand> waiting_;
  std::map<Request, std::int64_t> executed_;  ///< cycle, as the first reply says
  std::int64_t newest_leg_command_ = -1;
  LogFlaws flaws_;
};

}  // namespace sprung
