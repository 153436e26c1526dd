#pragma once
/// The zero of one drive's position: the offset in force, and whether it can still be trusted. Pure.
#include "drivers/bridge/bridge_core.h"
#include "robots/robot_config.h"

namespace sprung {

class ReferenceWatch {
 public:
  explicit ReferenceWatch(const ActuatorConfig& actuator) noexcept
      : reference_{actuator.offset_rad, actuator.referenced, ReferenceSource::kConfigured},
        absolute_encoder_(actuator.reference.absolute_encoder) {}

  const Reference& reference() const noexcept { return reference_; }
  /// Found: what was wrong before is forgotten.
  void set(const Reference& reference) noexcept;
  /// @param why static text, for people.
  void lose(const char* why) noexcept;
  /// The drive may have been without supply. A count that power keeps stays good; any other begins at zero.
  void doubt() noexcept;
  /// Once a cycle in which both encoders were measured. Apart for too long, the reference is lost.
  void compare(double motor_rad, double link_rad) noexcept;

  bool apart() const noexcept { return apart_; }       ///< until the reference is found anew
  const char* loss() const noexcept { return loss_; }  ///< static text; "" since it was found
  void show(NodeHealth& out) const noexcept;           ///< offset and source

 private:
  Reference reference_;
  bool absolute_encoder_;
  const char* loss_ = "";
  int cycles_apart_ = 0;  ///< in a row
  bool apart_ = false;
};

}  // namespace sprung
