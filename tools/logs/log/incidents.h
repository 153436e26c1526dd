#pragma once
/// What happened in a log, in words: changes of safety and of the motion's state, what befell legs, and
/// cycles of a lock-step run that were made from older messages than their own. Pure.
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "signals/modes.h"
#include "tools/logs/fields/decoder.h"
#include "tools/logs/log/event.h"
#include "tools/logs/log/timeline.h"
#include "tools/logs/log/went_on.h"

namespace sprung::log {

enum class IncidentKind : std::int8_t { kSession, kSafety, kMotion, kLeg, kNotDeterministic };
inline constexpr std::size_t kIncidentKinds = 5;

struct Incident {
  IncidentKind kind = IncidentKind::kMotion;
  double time_s = 0.0;    ///< robot's time since the log's begin
  std::int64_t seq = -1;  ///< cycle
  std::string text;
  bool trip = false;  ///< safety stops the robot, for a cause that is neither a start nor an orderly end
};

class IncidentFinder {
 public:
  /// @param leg_names by index; legs beyond them are named by number.
  explicit IncidentFinder(std::vector<std::string> leg_names = {}) : leg_names_(std::move(leg_names)) {}

  void add(const Event& event, const Timeline::Moment& moment);
  /// In their order; of each kind the first thousand.
  const std::vector<Incident>& incidents() const noexcept { return incidents_; }
  /// Those that were left out.
  std::int64_t left_out() const noexcept { return left_out_; }
  /// Of a lock-step run: cycles made from older messages than their own (signals/own_inputs.h). Such cycles
  /// in a row are one incident, that of the first.
  std::int64_t not_deterministic() const noexcept { return not_deterministic_; }
  /// Of a lock-step run: how often the bridge went on by wall time, without an answer of drives or
  /// controller.
  std::int64_t without_answer() const noexcept { return without_answer_; }
  /// Of a lock-step run: what its processes say of that themselves, each once: "sprung-sim-drives: no SYNC".
  const std::vector<std::string>& said() const noexcept { return said_; }
  /// How often each befell any leg, by LegEvent.
  const std::array<std::int64_t, kLegEventCount>& leg_counts() const noexcept { return leg_counts_; }

 private:
  static constexpr std::int64_t kNoCycle = -2;
  /// Where the fields of the newest MOTION_STATE's shape are.
  struct MotionFields {
    std::shared_ptr<const fields::Layout> layout;  ///< kept, so that no other gets its address
    int state = fields::Layout::kNone;
    int reason = fields::Layout::kNone;
    std::vector<std::array<int, kLegEventCount>> counts;  ///< of each leg
  };

  void add_command(const Timeline::Moment& moment);
  void note_not_deterministic(const Timeline::Moment& moment);
  void add_status(const Event& event, const Timeline::Moment& moment);
  void begin_session(std::int64_t session, const Timeline::Moment& moment);
  void add_safety(const Timeline::Moment& moment);
  void add_missed_cycles(const Event& event, const Timeline::Moment& moment);
  void add_motion(const Timeline::Moment& moment);
  void add_legs(const Timeline::Moment& moment);
  void find_motion_fields();
  void note(IncidentKind kind, const Timeline::Moment& moment, std::string text, bool trip = false);
  std::string text(int field) const;
  std::string leg_name(std::size_t leg) const;

  std::vector<std::string> leg_names_;
  fields::Decoder decoder_;
  fields::MessageView message_;
  std::int64_t session_ = 0;
  bool lockstep_ = false;
  std::int64_t command_seq_ = -1;  ///< newest, of the session
  std::int64_t not_deterministic_ = 0;
  std::int64_t without_answer_ = 0;
  WentOn went_on_;  ///< of the session
  std::vector<std::string> said_;
  std::int64_t alone_seq_ = kNoCycle;         ///< newest without an answer, of the session
  std::size_t alone_incident_ = 0;            ///< of incidents_, where it is in
  std::int64_t alone_times_ = 0;              ///< in that incident
  std::int64_t other_inputs_seq_ = kNoCycle;  ///< newest that was made from older messages, of the session
  std::size_t other_inputs_incident_ = 0;     ///< of incidents_, where it is in
  std::string safety_;
  std::string motion_;
  MotionFields motion_fields_;
  /// Event counts of each leg, as last published.
  std::vector<std::array<std::int64_t, kLegEventCount>> seen_;
  std::array<std::int64_t, kLegEventCount> leg_counts_{};
  std::array<std::int64_t, kIncidentKinds> of_kind_{};
  std::int64_t left_out_ = 0;
  std::vector<Incident> incidents_;
};

}  // namespace sprung::log
