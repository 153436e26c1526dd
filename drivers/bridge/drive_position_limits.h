#pragma once
/// A drive's own position limits (CiA 402 0x607D, :01 lowest, :02 highest): a stop that needs no bridge. They
/// count from the drive's zero, so they can only be written once the joint's zero is known, and again when it
/// is found anew; each is read back. Until both agree the drive gets no power. Pure.
#include <cstdint>
#include <limits>
#include <optional>

#include "drivers/canopen/protocol.h"
#include "robots/robot_config.h"
#include "signals/vec3.h"

namespace sprung {

/// [design choice] beyond robot.yaml's limits: further than the bridge's own hard limit (0.08 rad for 30 ms,
/// hard_limit_watch.h), since a drive faults at once.
inline constexpr double kDriveLimitMargin_rad = 0.1;

/// What one transfer does.
struct LimitTransfer {
  bool write = false;
  canopen::ObjectId object;
  std::uint32_t value = 0;
};

/// Of one actuator: the furthest that the limits of the joints of its leg allow, with the margin.
struct PositionRange {
  double low_rad = -std::numeric_limits<double>::infinity();
  double high_rad = std::numeric_limits<double>::infinity();
};
PositionRange drive_range(const RobotConfig& robot, int actuator);

class DrivePositionLimits {
 public:
  /// @param index 0: the drive is told none. @param range infinite: none either. @param counts_per_rad of
  /// the drive, at the gear's output, with the direction's sign.
  DrivePositionLimits(std::uint16_t index, const PositionRange& range, double counts_per_rad) noexcept;

  /// Once a cycle in which both are known. For each zero; and without power, where the joint lies beyond what
  /// the drive was told: it may come back. Once it is inside the limits are narrow again.
  /// @param zero_rad actuator position at the drive's count zero. @param here_rad the measured one.
  void follow(double zero_rad, double here_rad, bool powered) noexcept;
  /// The drive has begun anew, maybe with its own.
  void forget() noexcept;

  /// None: nothing is to be done.
  std::optional<LimitTransfer> next() const noexcept { return due() ? transfer() : std::nullopt; }
  void took(bool good, std::uint32_t value) noexcept;
  /// A refusal is forgotten: it is tried again.
  void retry() noexcept;

  bool confirmed() const noexcept { return index_ == 0 || step_ == kDone; }
  bool refused() const noexcept { return failures_ >= kTries; }

 private:
  static constexpr int kDone = 4;  ///< of two that are written and two that are read back
  static constexpr int kTries = 3;

  void want(std::int64_t one_counts, std::int64_t other_counts) noexcept;
  bool due() const noexcept { return index_ != 0 && wanted_ && step_ != kDone && !refused(); }
  std::optional<LimitTransfer> transfer() const noexcept;

  std::uint16_t index_;
  PositionRange range_;
  double counts_per_rad_;
  PositionRange told_;
  double told_zero_rad_ = kNaN;
  bool wanted_ = false;
  /// A lowest above the highest that the drive still has may be refused; that is not known where the drive
  /// kept it over a restart of ours, so each try has the other order.
  bool high_first_ = false;
  std::int32_t low_ = std::numeric_limits<std::int32_t>::min();
  std::int32_t high_ = std::numeric_limits<std::int32_t>::max();
  int step_ = 0;
  int failures_ = 0;  ///< in a row
};

}  // namespace sprung
