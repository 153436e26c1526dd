#pragma once
/// How well contact is found: fed once a cycle with what one leg's estimate says and the simulation's truth.
/// Pure.
///
/// A step is one swing of the foot, from begin_step() on: it leaves the ground (or hangs already), and may
/// meet the floor. Touchdown is the first true contact force after the foot was free for kFree_us; the
/// approach speed is the foot's downward speed in the cycle before. Bounces shorter than that belong to the
/// same contact.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "signals/enumeration.h"
#include "signals/joint_state.h"
#include "signals/simulation.h"

namespace sprung {

enum class ApproachClass { kFast, kMedium, kSlow };
constexpr auto words_of(ApproachClass) {
  return words<ApproachClass>({
      {ApproachClass::kFast, "fast"},
      {ApproachClass::kMedium, "medium"},
      {ApproachClass::kSlow, "slow"},
  });
}
/// Above 1 m/s, above 0.3 m/s, slower.
ApproachClass approach_class(double speed_m_s) noexcept;

struct ContactStep {
  std::optional<double> approach_speed_m_s;  ///< nothing: there was no floor, or it was not reached
  std::optional<double> delay_ms;  ///< first true force to the utime that reports it; nothing: not found
  std::optional<double> lift_off_delay_ms;  ///< of the contact before the swing, where there was one
  bool false_alarm = false;                 ///< contact reported in the swing
};

/// What is demanded of a robot that is identified.
constexpr double kLeastContactFound_percent = 99.0, kMostContactFalseAlarms_percent = 0.5;

struct ContactCounts {
  explicit ContactCounts(const std::vector<ContactStep>& steps) noexcept;
  double found_percent() const noexcept;         ///< of the touchdowns; NaN: there was none
  double false_alarms_percent() const noexcept;  ///< of the steps

  std::size_t steps = 0, touchdowns = 0, found = 0, false_alarms = 0;
};

class ContactScorer {
 public:
  /// Less than this without force is a bounce; so long contact may still be reported after lift-off; longer
  /// than this after touchdown is not found.
  static constexpr std::int64_t kFree_us = 50'000;
  static constexpr std::int64_t kLatest_us = 100'000;

  explicit ContactScorer(std::size_t leg) : leg_(leg) {}

  /// The step before, if any, is over.
  void begin_step();
  void add(const JointState& estimate, const SimTruth& truth);
  /// All steps with a swing; the last one too.
  const std::vector<ContactStep>& finish();

 private:
  enum class Phase { kNone, kBefore, kSwing, kLanded };
  void follow_take_off(bool force, bool reported, std::int64_t now_us);
  void follow_swing(bool force, bool reported, std::int64_t now_us);
  void follow_landing(bool reported, std::int64_t now_us);

  std::size_t leg_;
  Phase phase_ = Phase::kNone;
  ContactStep step_;
  std::vector<ContactStep> steps_;
  std::optional<std::int64_t> free_since_us_;
  std::optional<std::int64_t> lost_us_;  ///< when the contact before the swing was last reported to be over
  std::int64_t touchdown_us_ = 0;
  std::int64_t last_us_ = -1;
  double last_height_m_ = 0.0;
  double speed_m_s_ = 0.0;  ///< downward, of the cycle before
  bool reported_ = false;   ///< in the last cycle
};

}  // namespace sprung
