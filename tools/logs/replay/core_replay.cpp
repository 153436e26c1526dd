#include "tools/logs/replay/core_replay.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "controller/controller_core.h"
#include "lcmtypes/channels.h"
#include "planner/planner_core.h"
#include "tools/logs/replay/history.h"
#include "tools/logs/replay/message_slot.h"

namespace sprung {

namespace {

/// DRIVE_COMMAND ends with it and the MAC.
std::int64_t used_leg_command_seq(const Bytes& drive_command) {
  return read_int64(drive_command.data(), drive_command.size() - kMacBytes - sizeof(std::int64_t));
}

/// Every message begins with its type's fingerprint.
bool same_type(const Bytes& recorded, const Bytes& replayed) {
  return read_int64(recorded.data(), 0) == read_int64(replayed.data(), 0);
}

const Bytes kNoBytes;

}  // namespace

CoreChoice core_choice(const std::string& words) {
  CoreChoice choice;
  choice.runs = {};
  std::istringstream in(words);
  for (std::string word; std::getline(in, word, ',');) {
    const std::optional<Core> core = value_named<Core>(word);
    if (!core)
      throw std::invalid_argument("'" + word + "' is no core: give some of estimator,planner,controller");
    choice.runs[static_cast<std::size_t>(*core)] = true;
  }
  if (words.empty())
    throw std::invalid_argument("no core was named: give some of estimator,planner,controller");
  return choice;
}

struct CoreReplay::Impl {
  Impl(const RobotConfig& robot_in, const std::string& preset_in, const WatchdogConfig& watchdogs_in,
       const CoreChoice& choice_in)
      : robot(as_in_preset(robot_in, preset_in)),
        preset(robot.preset(preset_in)),
        watchdogs(watchdogs_in),
        choice(choice_in) {
    restart({true, true, true});
  }

  void restart(const std::array<bool, kCores>& which) {
    const auto is = [&](Core core) { return which[static_cast<std::size_t>(core)]; };
    if (is(Core::kPlanner)) planner = std::make_unique<PlannerCore>(robot, preset);
    if (is(Core::kController)) controller = std::make_unique<ControllerCore>(robot, preset, watchdogs);
  }

  void begin_anew() {
    restart({true, true, true});
    leg_history.clear();
  }

  void step(const LoggedCycle& cycle, EstimatedCycle& estimated);
  void run_controller(const LoggedCycle& cycle);
  void run_planner(const LoggedCycle& cycle);
  void take_leg_command(const LoggedCycle& cycle);
  void compare_replies(const LoggedCycle& cycle);
  void miss(const LoggedCycle& cycle, const MissingInput& input);
  template <class Signal>
  void compare(const LoggedCycle& cycle, const Bytes& recorded, MessageSlot<Signal>& ours);

  const RobotConfig robot;
  const PresetConfig& preset;
  const WatchdogConfig watchdogs;
  const CoreChoice choice;
  std::unique_ptr<PlannerCore> planner;
  std::unique_ptr<ControllerCore> controller;

  const CountLimits by_actuator = CountLimits::exactly(robot.actuators.size());
  const CountLimits by_leg = CountLimits::exactly(robot.legs.size());
  const CountLimits by_joint_and_leg = CountLimits::exactly(robot.joints.size(), robot.legs.size());
  MessageSlot<JointState> joint_state{channels::kJointState, by_joint_and_leg,
                                      JointState(robot.joints.size(), robot.legs.size())};
  MessageSlot<LegCommand> leg_command{channels::kLegCommand, by_leg, LegCommand(robot.legs.size())};
  MessageSlot<MotionState> motion_state{channels::kMotionState, by_leg, MotionState(robot.legs.size())};
  MessageSlot<DriveCommand> drive_command{channels::kDriveCommand, by_actuator,
                                          DriveCommand(robot.actuators.size())};
  MessageSlot<OperatorCommand> operator_command{channels::kOperatorCommand, CountLimits::none(), {}};
  MessageSlot<OperatorReply> reply{channels::kOperatorReply, CountLimits::none(), {}};
  History<LegCommand> leg_history{LegCommand(robot.legs.size())};

  bool planner_runs = false;  ///< leg commands come from the planner, not from an experiment
  std::int64_t session = 0;   ///< of the log
  double compare_from_s = -std::numeric_limits<double>::infinity();
  ReplayCounts counts;
  Use use_difference;
  Use use_output;
};

void CoreReplay::Impl::step(const LoggedCycle& cycle, EstimatedCycle& estimated) {
  if (cycle.anew) begin_anew();
  restart(cycle.restarted);
  if (!cycle.answered()) return;
  if (estimated.missing) miss(cycle, *estimated.missing);
  if (!estimated.known) return take_leg_command(cycle);
  std::swap(joint_state.value, estimated.joint_state);
  if (estimated.made) compare(cycle, cycle.joint_state, joint_state);
  if (counts.cycles == 0) counts.first_seq = cycle.seq;
  ++counts.cycles;
  counts.last_seq = cycle.seq;
  if (choice[Core::kController] && !cycle.drive_command.empty()) run_controller(cycle);
  run_planner(cycle);
}

void CoreReplay::Impl::run_controller(const LoggedCycle& cycle) {
  const std::int64_t used = used_leg_command_seq(cycle.drive_command);
  const LegCommand* const command = leg_history.find(used);
  if (used >= 0 && command == nullptr) miss(cycle, {"controller", channels::kLegCommand, used});
  controller->step(joint_state.value, command, drive_command.value);
  compare(cycle, cycle.drive_command, drive_command);
}

void CoreReplay::Impl::run_planner(const LoggedCycle& cycle) {
  planner_runs = planner_runs || !cycle.motion_state.empty();
  if (!choice[Core::kPlanner] || !planner_runs) return take_leg_command(cycle);
  if (cycle.leg_command.empty() && cycle.motion_state.empty()) return;
  for (const Bytes& bytes : cycle.operator_commands) {
    if (operator_command.read(bytes)) (void)planner->submit(operator_command.value);
  }
  planner->step(joint_state.value, leg_command.value, motion_state.value);
  leg_history.keep(leg_command.value);
  compare(cycle, cycle.leg_command, leg_command);
  compare(cycle, cycle.motion_state, motion_state);
  compare_replies(cycle);
}

void CoreReplay::Impl::take_leg_command(const LoggedCycle& cycle) {
  if (leg_command.read(cycle.leg_command)) leg_history.keep(leg_command.value);
}

/// Every reply in the log was made; that others were made too may be because a reader came late.
void CoreReplay::Impl::compare_replies(const LoggedCycle& cycle) {
  std::vector<Bytes> made;
  while (planner->next_reply(reply.value)) {
    made.push_back(reply.write(session));
    if (use_output)
      use_output({reply.channel(), cycle.seq, cycle.time_us, cycle.time_s, kNoBytes, made.back()});
  }
  if (cycle.time_s < compare_from_s) return;
  for (const Bytes& recorded : cycle.replies) {
    ++counts.compared;
    if (std::find(made.begin(), made.end(), recorded) != made.end()) continue;
    const Bytes& nearest = made.empty() ? kNoBytes : made.front();
    ++counts.differing;
    if (use_difference)
      use_difference({reply.channel(), cycle.seq, cycle.time_us, cycle.time_s, recorded, nearest});
  }
}

void CoreReplay::Impl::miss(const LoggedCycle& cycle, const MissingInput& input) {
  if (counts.incomplete++ > 0) return;
  counts.first_incomplete = std::string("cycle ") + std::to_string(cycle.seq) + ": the " + input.core +
                            " had " + input.channel + " " + std::to_string(input.seq) +
                            ", which is not in the log";
}

template <class Signal>
void CoreReplay::Impl::compare(const LoggedCycle& cycle, const Bytes& recorded, MessageSlot<Signal>& ours) {
  if (!recorded.empty()) session = read_int64(recorded.data(), kSessionOffset);
  const Bytes& replayed = ours.write(session);
  if (use_output) use_output({ours.channel(), cycle.seq, cycle.time_us, cycle.time_s, recorded, replayed});
  if (recorded.empty() || cycle.time_s < compare_from_s) return;
  if (!same_type(recorded, replayed)) {
    if (counts.other_version++ == 0) counts.first_other_version = ours.channel();
    return;
  }
  ++counts.compared;
  if (ours.same(recorded)) return;
  ++counts.differing;
  if (use_difference)
    use_difference({ours.channel(), cycle.seq, cycle.time_us, cycle.time_s, recorded, replayed});
}

CoreReplay::CoreReplay(const RobotConfig& robot, const std::string& preset, const WatchdogConfig& watchdogs,
                       const CoreChoice& choice)
    : impl_(std::make_unique<Impl>(robot, preset, watchdogs, choice)) {}

CoreReplay::~CoreReplay() = default;

void CoreReplay::on_difference(Use use) { impl_->use_difference = std::move(use); }
void CoreReplay::compare_from(double time_s) { impl_->compare_from_s = time_s; }
void CoreReplay::on_output(Use use) { impl_->use_output = std::move(use); }
void CoreReplay::step(const LoggedCycle& cycle, EstimatedCycle& estimated) { impl_->step(cycle, estimated); }
const ReplayCounts& CoreReplay::counts() const noexcept { return impl_->counts; }

}  // namespace sprung
