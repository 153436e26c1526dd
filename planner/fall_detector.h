#pragma once
/// Whether a robot on legs has fallen: tilted too far, or too low over its feet. Pure.
#include "robots/gait_config.h"
#include "signals/joint_state.h"

namespace sprung {

class FallDetector {
 public:
  explicit FallDetector(const BodyConfig& body) noexcept
      : tilt_rad_(body.fallen_tilt_rad), height_m_(body.fallen_height_m), has_body_(body.mass_kg > 0.0) {}

  /// Of a robot that ought to be upright. What is not known says nothing.
  bool fell(const EstimatedBody& body) const noexcept;
  /// Too far over to get up from; nullptr: it may stand up.
  const char* why_not_up(const EstimatedBody& body) const noexcept;

 private:
  bool tilted(const EstimatedBody& body) const noexcept;

  double tilt_rad_;
  double height_m_;
  bool has_body_;
};

}  // namespace sprung
