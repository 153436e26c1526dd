#pragma once
/// Position and velocity of one actuator for the bridge's own damping. A sample that cannot be (a flipped
/// bit, an encoder that jumped) is rejected and touches neither; velocity is differences through a
/// first-order low-pass. Pure.
#include <cstdint>

namespace sprung {

/// What one more sample says.
enum class Motion : std::int8_t {
  kGood,
  kRejected,  ///< further than anything turns: kept out
  kJumped,    ///< the same place again and again, but not where it was: the position goes on from there
};

/// When a sample was taken: between the two ends, so no more time than from the earliest of one until the
/// reception of the next can lie between two positions.
struct SampleTime {
  std::int64_t sync_us = 0;  ///< of the cycle that it counts for
  /// Of the oldest SYNC that it may answer: sync_us unless older answers have not come.
  std::int64_t earliest_us = 0;
  std::int64_t received_us = 0;
};

class PositionTracker {
 public:
  /// @param speed_limit_rad_s of the actuator; what moves several times faster is no measurement.
  /// @param quantum_rad of the measured position: encoder counts at the output.
  PositionTracker(double speed_limit_rad_s, double quantum_rad) noexcept
      : speed_limit_rad_s_(speed_limit_rad_s), quantum_rad_(quantum_rad) {}

  /// Several rejected samples in a row that follow one another show that the position itself has jumped; no
  /// velocity comes from that.
  Motion add(double measured_position_rad, const SampleTime& time) noexcept;
  /// The drive begins anew: at rest, but where it was, as far as it cannot have turned in the meantime.
  void resume() noexcept;

  double position_rad() const noexcept {
    return good_.position_rad;
  }  ///< last good sample; 0 before the first
  double filtered_velocity_rad_s() const noexcept { return velocity_rad_s_; }
  /// Between the last two good samples, not filtered.
  double latest_velocity_rad_s() const noexcept { return latest_velocity_rad_s_; }

 private:
  struct Sample {
    double position_rad = 0.0;
    SampleTime time;
    bool known = false;
  };
  bool can_follow(const Sample& before, double position_rad, std::int64_t received_us) const noexcept;
  void forget_rejected() noexcept;

  double speed_limit_rad_s_;
  double quantum_rad_;
  double velocity_rad_s_ = 0.0;
  double latest_velocity_rad_s_ = 0.0;
  Sample good_;
  bool resumed_ = false;     ///< no good sample since resume()
  Sample rejected_;          ///< the last one, until a good one came
  int rejected_beside_ = 0;  ///< rejected samples in a row, each where the one before was
};

}  // namespace sprung
