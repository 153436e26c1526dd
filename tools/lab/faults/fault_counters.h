#pragma once
/// Which counters of BUS_STATE grew between two looks.
#include <cstdint>
#include <string>

#include "signals/bus_state.h"

namespace sprung {

/// Everything counted there that is not ordinary traffic.
std::int64_t trouble_count(const BusState& state);
/// "missing_samples 12, emergencies 1"; empty where nothing grew.
std::string grown_counters(const BusState& before, const BusState& after);

}  // namespace sprung
