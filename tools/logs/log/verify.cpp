#include "tools/logs/log/verify.h"

#include <algorithm>
#include <cstdio>

#include "lcmtypes/channels.h"
#include "runtime/process_options.h"
#include "signals/own_inputs.h"
#include "tools/logs/log/cycle_stretches.h"
#include "tools/logs/log/used_inputs.h"
#include "tools/logs/log/went_on.h"
#include "tools/logs/log/writer.h"
#include "tools/logs/recorder/gap_tracker.h"

namespace sprung::log {

namespace {

using Kind = Finding::Kind;

constexpr std::int64_t kShownOfAKind = 20;

bool is_wrong(Kind kind) {
  return kind != Kind::kUnfinished && kind != Kind::kOrder && kind != Kind::kUnknown && kind != Kind::kLate &&
         kind != Kind::kOlder;
}

/// Of any two numbers: a damaged event may say what it likes. @param from <= to.
std::string microseconds_between(std::int64_t from, std::int64_t to) {
  return std::to_string(static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from));
}

bool is_ours(std::string_view channel) {
  using namespace channels;
  const std::string_view ours[] = {kDriveState,    kDriveCommand,  kJointState,    kLegCommand,
                                   kMotionState,   kSafetyState,   kSimControl,    kOperatorCommand,
                                   kOperatorReply, kProcessStatus, kBusState,      kCanTrace,
                                   kSimTruth,      kImu,           kTorqueSensor,  kLogMetadata,
                                   kLogEnd,        kBodyState,     kAuxiliaryState};
  return std::find(std::begin(ours), std::end(ours), channel) != std::end(ours);
}

/// Cycles of one session that are not there.
struct MissingCycles {
  std::int64_t gaps = 0;
  std::map<std::string, std::int64_t> cycles;  ///< by channel
  std::vector<std::string> first;              ///< what and where, of as many as are shown
};

/// By which clock a session's processes say that they go: LOG_METADATA does, and PROCESS_STATUS in other
/// programs' logs. In real time nobody waits for them.
class SessionClocks {
 public:
  void add(const Event& event, const Timeline::Moment& moment) {
    if (event.channel != channels::kLogMetadata && event.channel != channels::kProcessStatus) return;
    if (!moment.stamp || decoder_.open(event.data, event.size, message_) != fields::Fault::kNone) return;
    const int clock = message_.layout()->find("clock");
    if (clock == fields::Layout::kNone) return;
    sessions_.emplace(moment.stamp->session, message_.text(message_.fields()[clock]));
  }
  bool is(std::int64_t session, ClockMode clock) const {
    const auto found = sessions_.find(session);
    return found != sessions_.end() && found->second == name(clock);
  }

 private:
  fields::Decoder decoder_;
  fields::MessageView message_;
  std::map<std::int64_t, std::string> sessions_;
};

/// Where a session's processes went on without the others.
struct OnTheirOwn {
  WentOn went_on;
  CycleStretches bridge;          ///< cycles in which it had no answer
  std::vector<std::string> said;  ///< by the processes
};

class Verifier {
 public:
  explicit Verifier(bool being_written) { result_.being_written = being_written; }
  void add(const Event& event);
  VerifyResult finish(const Reader& reader);

 private:
  void find(Kind kind, const std::string& text);
  void check_place(const Event& event);
  void check_message(const Event& event);
  void check_cycle(const Event& event, const Timeline::Moment& moment);
  void check_inputs(const Event& event, const Timeline::Moment& moment);
  void check_answers(const Event& event, const Timeline::Moment& moment);
  void finish_cycles();
  void finish_inputs();
  void finish_damages(const Reader& reader);
  std::string at(const Event& event) const;

  VerifyResult result_;
  MessageCheck messages_;
  Timeline timeline_;
  std::int64_t last_number_ = -1;
  std::int64_t last_time_us_ = 0;
  std::map<std::string, SessionGapTracker, std::less<>> cycles_;
  std::map<std::int64_t, MissingCycles> missing_;  ///< by session
  SessionClocks clocks_;
  std::map<std::int64_t, CycleStretches> older_;  ///< DRIVE_COMMANDs made from older messages, by session
  std::map<std::int64_t, OnTheirOwn> alone_;      ///< by session
  std::int64_t recorder_missed_ = 0;              ///< cycles, as LOG_END says
  std::set<std::string, std::less<>> unknown_;    ///< channels whose type was named already
  bool has_metadata_ = false;
  bool has_end_ = false;
};

void Verifier::find(Kind kind, const std::string& text) {
  if (++result_.counts[kind] <= kShownOfAKind) result_.findings.push_back({kind, is_wrong(kind), text});
}

std::string Verifier::at(const Event& event) const {
  return "event " + std::to_string(event.number) + " (" + std::string(event.channel) + ", byte " +
         std::to_string(event.offset) + ")";
}

void Verifier::add(const Event& event) {
  const Timeline::Moment moment = timeline_.next(event);
  check_place(event);
  check_message(event);
  check_cycle(event, moment);
  check_inputs(event, moment);
  check_answers(event, moment);
  clocks_.add(event, moment);
  last_number_ = event.number;
  last_time_us_ = event.time_us;
  ++result_.events;
}

void Verifier::check_place(const Event& event) {
  // A number that starts again is a file that was put behind another.
  const bool jumps = event.number != 0 && (event.number <= last_number_ || event.number - 1 > last_number_);
  if (jumps) find(Kind::kNumbers, at(event) + " comes after event " + std::to_string(last_number_));
  if (result_.events > 0 && event.time_us < last_time_us_)
    find(Kind::kOrder, at(event) + " was received " + microseconds_between(event.time_us, last_time_us_) +
                           " us before the one in front of it");
}

void Verifier::check_message(const Event& event) {
  const fields::Fault fault = messages_.check(event);
  if (fault == fields::Fault::kUnknownType) {
    if (unknown_.emplace(event.channel).second) {
      const Kind kind = is_ours(event.channel) ? Kind::kOtherType : Kind::kUnknown;
      find(kind, at(event) + " is of a type that this sprung does not know");
    }
  } else if (fault != fields::Fault::kNone) {
    find(Kind::kMessage, at(event) + " is no message: " + name(fault));
  }
  has_metadata_ = has_metadata_ || event.channel == channels::kLogMetadata;
  if (event.channel != channels::kLogEnd) return;
  has_end_ = true;
  const auto end = read_log_end(event.data, event.size);
  if (end) recorder_missed_ += std::clamp<std::int64_t>(end->missing, 0, kLastCycle);
  if (end && end->events != event.number)
    find(Kind::kCount, at(event) + " says that " + std::to_string(end->events) + " events come before it");
}

void Verifier::check_cycle(const Event& event, const Timeline::Moment& moment) {
  if (!moment.stamp || !has_every_cycle(event.channel)) return;
  auto found = cycles_.find(event.channel);
  if (found == cycles_.end()) found = cycles_.emplace(event.channel, SessionGapTracker()).first;
  const std::int64_t before = found->second.counts().missing;
  const std::int64_t missing = found->second.add(moment.stamp->session, moment.stamp->seq);
  const std::int64_t more = found->second.counts().missing - before;
  if (more == 0) return;
  MissingCycles& all = missing_[moment.stamp->session];
  all.cycles[found->first] += more;  // one that comes out of its order is not missing after all
  if (missing == 0 || ++all.gaps > kShownOfAKind) return;
  char time[40];
  std::snprintf(time, sizeof time, "%.3f s", moment.time_s);
  all.first.push_back(std::string(event.channel) + " misses " + std::to_string(missing) +
                      " cycles before cycle " + std::to_string(moment.stamp->seq) + ", at " + time);
}

void Verifier::check_inputs(const Event& event, const Timeline::Moment& moment) {
  if (!moment.stamp || event.channel != channels::kDriveCommand) return;
  const auto used = used_inputs(event.data, event.size);
  if (used && !made_from_own_inputs(used->seq, used->joint_state_seq, used->leg_command_seq))
    older_[moment.stamp->session].add(used->seq);
}

void Verifier::check_answers(const Event& event, const Timeline::Moment& moment) {
  const bool safety = event.channel == channels::kSafetyState;
  if (!moment.stamp || (!safety && event.channel != channels::kProcessStatus)) return;
  OnTheirOwn& alone = alone_[moment.stamp->session];
  if (safety && alone.went_on.add_safety(event.data, event.size) > 0) alone.bridge.add(moment.stamp->seq);
  if (safety) return;
  const std::string said = alone.went_on.add_status(event.data, event.size);
  if (!said.empty()) alone.said.push_back(said);
}

/// The log may be whole all the same; in real time they are nothing special.
void Verifier::finish_inputs() {
  for (const auto& [session, older] : older_) {
    if (!clocks_.is(session, ClockMode::kLockstep)) continue;
    find(Kind::kOlder, "not deterministic: " + std::to_string(older.cycles()) +
                           " cycles made from older messages than their own: " + older.text());
  }
  for (const auto& [session, alone] : alone_) {
    if (!clocks_.is(session, ClockMode::kLockstep)) continue;
    if (!alone.bridge.empty())
      find(Kind::kOlder, "not deterministic: the bridge went on without an answer in " +
                             std::to_string(alone.bridge.cycles()) + " cycles: " + alone.bridge.text());
    for (const std::string& said : alone.said) find(Kind::kOlder, "not deterministic: " + said);
  }
}

/// In real time a cycle may be late or lost, but then the recorder did not have it either.
void Verifier::finish_cycles() {
  for (const auto& [session, missing] : missing_) {
    const Kind kind = clocks_.is(session, ClockMode::kRealTime) ? Kind::kLate : Kind::kMissing;
    for (const std::string& text : missing.first) find(kind, text);
    if (missing.gaps > kShownOfAKind) result_.counts[kind] += missing.gaps - kShownOfAKind;
    if (kind != Kind::kLate) continue;
    for (const auto& [channel, cycles] : missing.cycles)
      if (cycles > 0) result_.late[channel] += cycles;
  }
  const std::int64_t late = result_.late_cycles();
  if (has_end_ && late > recorder_missed_)
    find(Kind::kMissing, std::to_string(late) +
                             " cycles are not there, and LOG_END says that the recorder missed " +
                             std::to_string(recorder_missed_) + ": the others were taken out of the file");
}

void Verifier::finish_damages(const Reader& reader) {
  for (const Damage& damage : reader.damages()) {
    const bool cut = damage.kind == DamageKind::kCutOff;
    if (cut && result_.being_written) continue;  // the rest of the event is on its way
    find(cut ? Kind::kCutOff : Kind::kGarbage, (cut ? "the log ends inside an event: " : "no event: ") +
                                                   std::to_string(damage.bytes) + " bytes from byte " +
                                                   std::to_string(damage.offset));
  }
  result_.counts[Kind::kGarbage] += static_cast<std::int64_t>(reader.damage_count() -
                                                              reader.damages().size());
}

VerifyResult Verifier::finish(const Reader& reader) {
  finish_cycles();
  finish_damages(reader);
  finish_inputs();
  if (!has_end_ && result_.being_written)
    find(Kind::kUnfinished, "there is no LOG_END yet: it is still being written");
  else if (has_metadata_ && !has_end_)
    find(Kind::kUnfinished, "there is no LOG_END: cut out of another log, or the recorder was killed");
  result_.bytes = reader.position();
  result_.skipped_bytes = reader.skipped_bytes();
  if (result_.being_written && ends_inside_an_event(reader))
    result_.skipped_bytes -= reader.damages().back().bytes;
  return result_;
}

std::string late_text(const VerifyResult& result) {
  std::string channels;
  for (const auto& [channel, cycles] : result.late)
    channels += (channels.empty() ? "" : ", ") + channel + " " + std::to_string(cycles);
  const std::string cycles = std::to_string(result.late_cycles()) + " cycles ";
  if (!result.good()) return "; " + cycles + "are not there (" + channels + ")";
  return "; in real time " + cycles + "came too late or were lost on the way (" + channels +
         "): no damage, a replay goes around them";
}

}  // namespace

bool VerifyResult::good() const noexcept {
  return std::none_of(counts.begin(), counts.end(),
                      [](const auto& count) { return count.second > 0 && is_wrong(count.first); });
}

std::int64_t VerifyResult::late_cycles() const noexcept {
  std::int64_t sum = 0;
  for (const auto& [channel, cycles] : late) sum += cycles;
  return sum;
}

VerifyResult verify(Reader& reader, const Progress& progress) {
  Verifier verifier(is_being_written(reader.path()));
  std::int64_t events = 0;
  for (Event event; reader.next(event);) {
    verifier.add(event);
    if (progress && ++events % kEventsBetween == 0) progress(reader.position(), reader.file_bytes());
  }
  return verifier.finish(reader);
}

std::string verify_text(const std::string& path, const VerifyResult& result) {
  std::string out;
  for (const Finding& finding : result.findings)
    out += std::string(finding.wrong ? "WRONG  " : "note   ") + finding.text + "\n";
  for (const auto& [kind, count] : result.counts) {
    if (count > kShownOfAKind) out += "       " + std::to_string(count) + " " + name(kind) + " in all\n";
  }
  const std::string what = std::to_string(result.events) + " events, " + std::to_string(result.bytes) +
                           " bytes";
  out += path + ": " + (result.good() ? "good" : "NOT good") + ", " + what;
  if (result.skipped_bytes > 0) out += ", " + std::to_string(result.skipped_bytes) + " of them in no event";
  if (!result.late.empty()) out += late_text(result);
  if (result.being_written) out += "; still being written: this is so far";
  return out + "\n";
}

}  // namespace sprung::log
