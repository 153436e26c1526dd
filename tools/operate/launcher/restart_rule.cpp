#include "tools/operate/launcher/restart_rule.h"

namespace sprung {

bool RestartRule::hopeful(const EndedProcess& ended) noexcept {
  const bool allowed = ended.harmless ? ended.by_signal : ended.policy == RestartPolicy::kWithoutTorque;
  return allowed && ended.restarts < kMost && (ended.harmless || !ended.lockstep);
}

bool RestartRule::due(const EndedProcess& ended, const std::optional<TorqueHeard>& torque,
                      std::int64_t now_us) noexcept {
  if (!hopeful(ended)) return false;
  if (ended.harmless) return true;
  return torque && !torque->any && torque->utime_us >= ended.ended_utime_us + kSettle_us &&
         now_us - torque->utime_us <= kFresh_us;
}

}  // namespace sprung
