#pragma once
/// `sprung fault`: what an operator types as a SIM_CONTROL for the simulated drives. Pure.
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/simulation.h"

namespace sprung {

/// What a fault can be given to, what its value means, and what to look at when it acts.
struct FaultGuide {
  FaultKind kind = FaultKind::kNone;
  bool on_drive = true;
  bool on_bus = false;
  const char* value = "";    ///< meaning and unit of --value, "" = takes none
  double usual_value = 0.0;  ///< where none is given
  const char* watch = "";    ///< one sentence
};
/// Every kind that there is, `none` first: it mends.
const std::vector<FaultGuide>& fault_guides();

struct FaultRequest {
  std::string target;  ///< joint, actuator or bus, by name
  std::string kind;
  std::optional<double> value;
  double for_s = 0.0;  ///< 0 = until mended
};

/// apply_at_seq is the caller's to set.
/// @throws std::invalid_argument naming the targets there are, or why this one cannot have that fault.
SimControl fault_control(const RobotConfig& robot, const FaultRequest& request);
const FaultGuide& guide_of(FaultKind kind);

/// What is told before it happens, "over-current at knee: acts at cycle 1200 for 0.5 s", and then: what to
/// look at. `none` makes no fault but takes away what was made.
std::string announcement(const FaultRequest& request, const SimControl& control);
std::string effect_text(FaultKind kind);

/// Of an actuator, or of the joint that it belongs to. @throws std::invalid_argument naming those there are.
int actuator_named(const RobotConfig& robot, const std::string& name);

}  // namespace sprung
