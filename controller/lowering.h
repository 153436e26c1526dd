#pragma once
/// Lets a robot down that stands on its legs while nobody plans any more. Pure; no heap after construction.
///
/// Every foot is led by its drives' position loops along the polynomial of least jerk: a foot that stands,
/// from where it is to the preset's `sit_length` below its hip, or not at all where it is nearer; so no leg
/// is ever stretched, whatever ground it stands on. A foot that was lifted is put down within kPutDown_s to
/// where the standing ones are on average. Where a foot stands ahead or aside of its hip, it stays. What
/// flies or thrusts is not lowered: damping takes more out of that than a stiff leg.
#include <vector>

#include "signals/joint_state.h"
#include "signals/leg_command.h"

namespace sprung {

/// [design choice] a swing foot is up to 0.08 m high; that far in 0.2 s is what a gait does.
inline constexpr double kPutDown_s = 0.2;

class Lowering {
 public:
  /// @param sit_length_m hip to foot, where it ends. @param duration_s RobotConfig::lowering_s.
  Lowering(std::size_t leg_count, double sit_length_m, double duration_s);

  /// @param last what the legs did; @param state where their feet are.
  /// @return false, and nothing begins: a leg without power, in joint mode, in thrust or flight, a foot that
  /// is not known, or none that stands.
  bool begin(const LegCommand& last, const JointState& state) noexcept;
  bool running() const noexcept { return running_; }
  void end() noexcept { running_ = false; }

  /// @param time_us message time; after its duration it ends by itself.
  /// @return what the legs shall do now; its stamp is `time_us`.
  const LegCommand& at(std::int64_t time_us) noexcept;

 private:
  struct Foot {
    double from_m = 0.0;  ///< z, hip axes
    bool stands = false;
  };
  double way_m(const Foot& foot) const noexcept;

  bool running_ = false;
  double sit_length_m_;
  double duration_s_;
  std::int64_t began_us_ = 0;
  std::vector<Foot> feet_;
  LegCommand command_;
};

}  // namespace sprung
