#include "tools/lab/faults/fault_counters.h"

namespace sprung {
namespace {

struct BusCounter {
  const char* name;
  std::int64_t BusHealth::*value;
};
struct NodeCounter {
  const char* name;
  std::int64_t NodeHealth::*value;
};

constexpr BusCounter kBusCounters[] = {
    {"send_failed", &BusHealth::send_failed}, {"no_buffers", &BusHealth::no_buffers},
    {"dropped", &BusHealth::dropped},         {"malformed", &BusHealth::malformed},
    {"unexpected", &BusHealth::unexpected},   {"error_frames", &BusHealth::error_frames},
    {"bus_offs", &BusHealth::bus_offs},       {"restarts", &BusHealth::restarts},
};
constexpr NodeCounter kNodeCounters[] = {
    {"emergencies", &NodeHealth::emergencies},
    {"boot_ups", &NodeHealth::boot_ups},
    {"missing_samples", &NodeHealth::missing_samples},
    {"late_samples", &NodeHealth::late_samples},
    {"short_frames", &NodeHealth::short_frames},
    {"duplicate_samples", &NodeHealth::duplicate_samples},
    {"implausible_samples", &NodeHealth::implausible_samples},
    {"heartbeat_losses", &NodeHealth::heartbeat_losses},
    {"sdo_failures", &NodeHealth::sdo_failures},
};

template <class Health, class Counter>
std::int64_t sum(const std::vector<Health>& all, const Counter& counter) {
  std::int64_t total = 0;
  for (const Health& one : all) total += one.*counter.value;
  return total;
}

void add(std::string& text, const char* name, std::int64_t growth) {
  if (growth > 0) text += (text.empty() ? "" : ", ") + std::string(name) + " " + std::to_string(growth);
}

}  // namespace

std::int64_t trouble_count(const BusState& state) {
  std::int64_t total = 0;
  for (const BusCounter& counter : kBusCounters) total += sum(state.buses, counter);
  for (const NodeCounter& counter : kNodeCounters) total += sum(state.nodes, counter);
  return total;
}

std::string grown_counters(const BusState& before, const BusState& after) {
  std::string text;
  for (const BusCounter& counter : kBusCounters)
    add(text, counter.name, sum(after.buses, counter) - sum(before.buses, counter));
  for (const NodeCounter& counter : kNodeCounters)
    add(text, counter.name, sum(after.nodes, counter) - sum(before.nodes, counter));
  return text;
}

}  // namespace sprung
