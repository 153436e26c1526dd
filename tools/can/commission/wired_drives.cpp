#include "tools/can/commission/wired_drives.h"

#include "drivers/canopen/eds.h"
#include "drivers/profiles/drive_profile.h"
#include "drivers/profiles/profile_eds.h"

namespace sprung::commission {
namespace {

constexpr int kUsualPolePairs = 11;                 ///< where robot.yaml knows none [design choice]
constexpr double kFittingP = 800, kFittingI = 160;  ///< of an EPOS2 with such a motor [design choice]
constexpr DriveTiming kAnyTiming{0.002, 0.005, 0.02};

CommissioningPlan plan_of(const ActuatorConfig& machine) {
  return make_profile(machine, kAnyTiming)->commissioning(1e6);
}

sim::DriveWiring wired(const ActuatorConfig& machine, const CommissioningPlan& plan) {
  sim::DriveWiring wiring;
  wiring.given = true;
  wiring.pole_pairs = machine.pole_pairs > 0 ? machine.pole_pairs : kUsualPolePairs;
  for (const CommissioningObject& object : plan.objects) {
    if (object.topic != CommissioningTopic::kCurrentLoop) continue;
    wiring.fitting_p = machine.commissioning.current_p > 0 ? machine.commissioning.current_p : kFittingP;
    wiring.fitting_i = machine.commissioning.current_i > 0 ? machine.commissioning.current_i : kFittingI;
  }
  return wiring;
}

}  // namespace

sim::DriveWiring commissioned_drive(const ActuatorConfig& machine) {
  const CommissioningPlan plan = plan_of(machine);
  sim::DriveWiring wiring = wired(machine, plan);
  for (const CommissioningObject& object : plan.objects) {
    const bool gain = object.topic == CommissioningTopic::kCurrentLoop;
    const double fitting = object.object.sub == 1 ? wiring.fitting_p : wiring.fitting_i;
    wiring.stored.emplace_back(object.object, gain ? static_cast<std::int64_t>(fitting) : object.low);
  }
  return wiring;
}

sim::DriveWiring factory_drive(const ActuatorConfig& machine) {
  const CommissioningPlan plan = plan_of(machine);
  const canopen::Eds eds = profile_eds(*find_profile_kind(machine.profile), machine.node);
  sim::DriveWiring wiring = wired(machine, plan);
  for (const CommissioningObject& object : plan.objects) {
    const canopen::EdsObject* described = eds.find(object.object);
    if (object.topic != CommissioningTopic::kNodeId && described != nullptr)
      wiring.stored.emplace_back(object.object, described->default_value.value_or(0));
  }
  return wiring;
}

}  // namespace sprung::commission
