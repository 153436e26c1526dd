#include "tools/logs/log/incidents.h"

#include "lcmtypes/channels.h"
#include "signals/mode_names.h"
#include "signals/own_inputs.h"
#include "tools/logs/recorder/log_messages.h"

namespace sprung::log {

namespace {

/// Of a kind: a log may alternate between two sessions, or states, for hours.
constexpr std::int64_t kKept = 1000;

bool is_trip(const std::string& level, const std::string& cause) {
  const bool stops = !level.empty() && level != name(SafetyLevel::kOperational);
  return stops && !cause.empty() && cause != name(SafetyCause::kNone) &&
         cause != name(SafetyCause::kStarting) && cause != name(SafetyCause::kShutdown);
}

}  // namespace

void IncidentFinder::add(const Event& event, const Timeline::Moment& moment) {
  if (event.channel == channels::kLogMetadata) {
    const auto metadata = read_log_metadata(event.data, event.size);
    lockstep_ = metadata && metadata->clock == "lockstep";
  }
  if (event.channel == channels::kProcessStatus) return add_status(event, moment);
  const bool safety = event.channel == channels::kSafetyState;
  const bool command = lockstep_ && event.channel == channels::kDriveCommand;
  if (!safety && !command && event.channel != channels::kMotionState) return;
  if (decoder_.open(event.data, event.size, message_) != fields::Fault::kNone) return;
  if (moment.stamp && moment.stamp->session != session_) begin_session(moment.stamp->session, moment);
  if (command) return add_command(moment);
  if (safety && lockstep_) add_missed_cycles(event, moment);
  safety ? add_safety(moment) : add_motion(moment);
}

void IncidentFinder::begin_session(std::int64_t session, const Timeline::Moment& moment) {
  session_ = session;
  safety_.clear();
  motion_.clear();
  seen_.clear();
  command_seq_ = -1;
  went_on_.begin_anew();
  other_inputs_seq_ = alone_seq_ = kNoCycle;
  note(IncidentKind::kSession, moment, "session " + std::to_string(session_));
}

/// Of a session that has not begun here it is left to the next status, which says it again.
void IncidentFinder::add_status(const Event& event, const Timeline::Moment& moment) {
  if (!lockstep_ || !moment.stamp || moment.stamp->session != session_) return;
  const std::string what = went_on_.add_status(event.data, event.size);
  if (what.empty()) return;
  said_.push_back(what);
  note(IncidentKind::kNotDeterministic, moment, "not deterministic: " + what);
}

void IncidentFinder::add_command(const Timeline::Moment& moment) {
  const fields::Layout& layout = *message_.layout();
  const int joints = layout.find("used_joint_state_seq"), legs = layout.find("used_leg_command_seq");
  if (!moment.stamp || joints == fields::Layout::kNone || legs == fields::Layout::kNone) return;
  const std::int64_t seq = moment.stamp->seq;
  if (seq <= command_seq_) return;  // repeated
  command_seq_ = seq;
  const auto value = [&](int field) {
    return message_.integer(message_.fields()[static_cast<std::size_t>(field)]);
  };
  if (!made_from_own_inputs(seq, value(joints), value(legs))) note_not_deterministic(moment);
}

void IncidentFinder::note_not_deterministic(const Timeline::Moment& moment) {
  const std::int64_t seq = moment.stamp->seq;
  const bool goes_on = seq == other_inputs_seq_ + 1 && other_inputs_incident_ < incidents_.size();
  ++not_deterministic_;
  other_inputs_seq_ = seq;
  if (!goes_on) {
    other_inputs_incident_ = incidents_.size();
    note(IncidentKind::kNotDeterministic, moment, "");
    if (other_inputs_incident_ == incidents_.size()) return;  // one too many
  }
  Incident& incident = incidents_[other_inputs_incident_];
  incident.text = "not deterministic: made from older messages" +
                  (seq == incident.seq ? "" : ", up to cycle " + std::to_string(seq));
}

void IncidentFinder::add_missed_cycles(const Event& event, const Timeline::Moment& moment) {
  const std::int64_t more = went_on_.add_safety(event.data, event.size);
  if (more == 0 || !moment.stamp) return;
  const std::int64_t seq = moment.stamp->seq;
  const bool goes_on = seq == alone_seq_ + 1 && alone_incident_ < incidents_.size();
  without_answer_ += more;
  alone_seq_ = seq;
  if (!goes_on) {
    alone_incident_ = incidents_.size();
    alone_times_ = 0;
    note(IncidentKind::kNotDeterministic, moment, "");
    if (alone_incident_ == incidents_.size()) return;  // one too many
  }
  Incident& incident = incidents_[alone_incident_];
  alone_times_ += more;
  incident.text = "not deterministic: the bridge went on without an answer, times: " +
                  std::to_string(alone_times_) +
                  (seq == incident.seq ? "" : ", up to cycle " + std::to_string(seq));
}

void IncidentFinder::add_safety(const Timeline::Moment& moment) {
  const fields::Layout& layout = *message_.layout();
  const std::string level = text(layout.find("level_name"));
  std::string now = level;
  const std::string cause = text(layout.find("cause_name"));
  const std::string detail = text(layout.find("detail"));
  if (!cause.empty() && cause != "none") now += ", " + cause;
  if (!detail.empty()) now += ": " + detail;
  if (now == safety_) return;
  safety_ = now;
  note(IncidentKind::kSafety, moment, "safety " + now, is_trip(level, cause));
}

void IncidentFinder::find_motion_fields() {
  const fields::Layout& layout = *message_.layout();
  motion_fields_ = {message_.keep_layout(), layout.find("state_name"), layout.find("last_transition"), {}};
  for (std::size_t leg = 0;; ++leg) {
    const std::string counts = "legs[" + std::to_string(leg) + "].event_counts[";
    std::array<int, kLegEventCount> found{};
    for (std::size_t i = 0; i < kLegEventCount; ++i) found[i] = layout.find(counts + std::to_string(i) + "]");
    if (found[0] == fields::Layout::kNone) break;
    motion_fields_.counts.push_back(found);
  }
}

void IncidentFinder::add_motion(const Timeline::Moment& moment) {
  if (message_.layout() != motion_fields_.layout.get()) find_motion_fields();
  const std::string state = text(motion_fields_.state);
  if (state != motion_) {
    motion_ = state;
    const std::string why = text(motion_fields_.reason);
    note(IncidentKind::kMotion, moment, "motion " + state + (why.empty() ? "" : ": " + why));
  }
  add_legs(moment);
}

void IncidentFinder::add_legs(const Timeline::Moment& moment) {
  for (std::size_t leg = 0; leg < motion_fields_.counts.size(); ++leg) {
    std::array<std::int64_t, kLegEventCount> now{};
    for (std::size_t i = 0; i < kLegEventCount; ++i) {
      const int field = motion_fields_.counts[leg][i];
      if (field != fields::Layout::kNone)
        now[i] = message_.integer(message_.fields()[static_cast<std::size_t>(field)]);
    }
    if (seen_.size() <= leg) seen_.push_back(now);  // what befell it before the log begins is no news
    for (std::size_t i = 1; i < kLegEventCount; ++i) {
      if (now[i] <= seen_[leg][i]) continue;
      leg_counts_[i] += now[i] - seen_[leg][i];
      note(IncidentKind::kLeg, moment, "leg " + leg_name(leg) + " " + name(static_cast<LegEvent>(i)));
    }
    seen_[leg] = now;
  }
}

void IncidentFinder::note(IncidentKind kind, const Timeline::Moment& moment, std::string text, bool trip) {
  if (++of_kind_[static_cast<std::size_t>(kind)] > kKept) {
    ++left_out_;
    return;
  }
  incidents_.push_back({kind, moment.time_s, moment.stamp ? moment.stamp->seq : -1, std::move(text), trip});
}

std::string IncidentFinder::text(int field) const {
  if (field == fields::Layout::kNone) return "";
  return std::string(message_.text(message_.fields()[static_cast<std::size_t>(field)]));
}

std::string IncidentFinder::leg_name(std::size_t leg) const {
  return leg < leg_names_.size() ? leg_names_[leg] : std::to_string(leg);
}

}  // namespace sprung::log
