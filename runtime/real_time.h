#pragma once
/// Real-time set-up of a process, all of it: SCHED_FIFO, locked memory, CPU, touched stack. Call before
/// threads start: they inherit it.
#include <string>

#include "signals/enumeration.h"

namespace sprung {

enum class RealTimePolicy {
  kOff,      ///< ask for nothing
  kWarn,     ///< ask, run without what is refused
  kEnforce,  ///< refused is an error
};
constexpr auto words_of(RealTimePolicy) {
  using E = RealTimePolicy;
  return words<E>({{E::kOff, "off"}, {E::kWarn, "warn"}, {E::kEnforce, "enforce"}});
}

struct RealTimeRequest {
  RealTimePolicy policy = RealTimePolicy::kWarn;
  int priority = 0;  ///< SCHED_FIFO 1..99; 0 = normal scheduling
  int cpu = -1;      ///< pin to this one; -1 = any
};

/// @return what was granted, for PROCESS_STATUS: "SCHED_FIFO 45, memory locked, any cpu", or what was refused
/// and why.
/// @throws std::runtime_error under kEnforce, naming what was refused and the limit to raise.
std::string set_up_real_time(const RealTimeRequest& request);

/// Whether a text of set_up_real_time() contains a refusal.
bool real_time_refused(const std::string& granted);

}  // namespace sprung
