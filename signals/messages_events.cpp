/// The signals that come now and then: motion, safety, operator, simulation control.
#include <cstring>

#include "signals/message_fields.h"
#include "signals/messages.h"

namespace sprung {
namespace {

using fields::read;
using fields::write;

const auto kMotionLeg = [](auto& way, auto& m, auto& s) {
  way(m.phase, s.phase);
  way(m.phase_time_s, s.phase_time_s);
};

const auto kMotionState = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way.elements(m.n_legs, m.legs, s.legs, kMotionLeg);
  way(m.state, s.state);
  way(m.jumps_done, s.jumps_done);
  way(m.jumps_left, s.jumps_left);
  way(m.jump_height_scale, s.jump_height_scale);
  way(m.jump_mode, s.jump_mode);
};

const auto kSafetyState = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.level, s.level);
  way(m.cause, s.cause);
  way(m.latched, s.latched);
  way(m.actuator, s.actuator);
  way(m.since_seq, s.since_seq);
  way(m.commands_refused, s.commands_refused);
  way(m.overruns, s.overruns);
  way(m.missed_cycles, s.missed_cycles);
};

const auto kOperatorCommand = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.request_id, s.request_id);
  way(m.apply_at_seq, s.apply_at_seq);
  way(m.kind, s.kind);
  way(m.jump_mode, s.jump_mode);
  way(m.jump_count, s.jump_count);
  way(m.jump_height_m, s.jump_height_m);
};

const auto kOperatorReply = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.request_id, s.request_id);
  way(m.took_effect_at_seq, s.took_effect_at_seq);
  way(m.outcome, s.outcome);
};

const auto kSimControl = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.apply_at_seq, s.apply_at_seq);
  way(m.wrench_on_base, s.wrench_on_base);
  way(m.duration_s, s.duration_s);
  way(m.kind, s.kind);
  way(m.actuator, s.actuator);
  way(m.value, s.value);
};

}  // namespace

void to_message(const MotionState& in, std::int64_t session, sprung_msgs::motion_state_t& out) {
  write(kMotionState, in, session, out);
  out.state_name = name(in.state);
  out.last_transition = in.last_transition;
}
void to_message(const SafetyState& in, std::int64_t session, sprung_msgs::safety_state_t& out) {
  write(kSafetyState, in, session, out);
  out.level_name = name(in.level);
  out.cause_name = name(in.cause);
  out.detail.assign(in.detail.data(), strnlen(in.detail.data(), in.detail.size()));
}
void to_message(const OperatorCommand& in, std::int64_t session, sprung_msgs::operator_command_t& out) {
  write(kOperatorCommand, in, session, out);
}
void to_message(const OperatorReply& in, std::int64_t session, sprung_msgs::operator_reply_t& out) {
  write(kOperatorReply, in, session, out);
  out.from = in.from;
  out.reason = in.reason;
}
void to_message(const SimControl& in, std::int64_t session, sprung_msgs::sim_control_t& out) {
  write(kSimControl, in, session, out);
}

bool from_message(const sprung_msgs::motion_state_t& in, MotionState& out) {
  out.last_transition = in.last_transition.c_str();
  return read(kMotionState, in, out);
}
bool from_message(const sprung_msgs::safety_state_t& in, SafetyState& out) {
  out.detail.fill('\0');
  in.detail.copy(out.detail.data(), out.detail.size() - 1);
  return read(kSafetyState, in, out);
}
bool from_message(const sprung_msgs::operator_command_t& in, OperatorCommand& out) {
  return read(kOperatorCommand, in, out);
}
bool from_message(const sprung_msgs::operator_reply_t& in, OperatorReply& out) {
  out.from = in.from.c_str();
  out.reason = in.reason.c_str();
  return read(kOperatorReply, in, out);
}
bool from_message(const sprung_msgs::sim_control_t& in, SimControl& out) {
  return read(kSimControl, in, out);
}

}  // namespace sprung
