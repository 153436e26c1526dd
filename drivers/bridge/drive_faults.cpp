/// What is wrong with a drive that should be running, in words: one cause each time, the drive's own first.
#include "drivers/bridge/drive_node.h"

namespace sprung {
namespace {

constexpr std::int64_t kModeLimit_us = 1'000'000;

}  // namespace

bool DriveNode::fault(std::int64_t time_us, bool ignore_faults, Fault& out) const noexcept {
  const char* drive = actuator_.name.c_str();
  const bool judges_drive = !link().duplicate() && !ignore_faults;
  const std::uint16_t code = link().emergencies().emergency().code;
  if (judges_drive && condition().faulted) {
    out.cause = SafetyCause::kDriveFault;
    out.unexplained = code == 0;
    print(out.detail, "%s: drive fault 0x%04X (%s), state %s", drive, code, canopen::emergency_text(code),
          sprung::name(power_state_));
  } else if (judges_drive && power_.lost_power() && !link().lost(time_us)) {
    out.cause = SafetyCause::kDriveFault;
    print(out.detail, "%s: lost its power by itself", drive);
  } else {
    return link().fault(time_us, ignore_faults, out) || drive_fault(out) || supply_fault(out) ||
           temperature_fault(out);
  }
  return true;
}

bool DriveNode::drive_fault(Fault& out) const noexcept {
  const char* drive = actuator_.name.c_str();
  if (implausible_) {
    out.cause = SafetyCause::kImplausible;
    print(out.detail, "%s: measured position jumped to %g rad", drive,
          sample_.measured_position_rad + reference().offset_rad);
  } else if (stuck_.stuck()) {
    out.cause = SafetyCause::kImplausible;
    print(out.detail, "%s: encoder stuck: not one count in %lld ms under %.0f Nm, though it must move", drive,
          static_cast<long long>(stuck_.still_us() / 1000), stuck_.torque_Nm());
  } else if (noise_.noisy()) {
    out.cause = SafetyCause::kImplausible;
    print(out.detail, "%s: encoder noisy: it jitters by %.2g rad, faster than any torque turns it", drive,
          noise_.noise_rad());
  } else if (impact_.hit()) {
    out.cause = SafetyCause::kImplausible;
    print(out.detail,
          "%s: hit something: its speed changed by %.2g rad/s in 8 ms; reference lost; check direction, zero",
          drive, impact_.change_rad_s());
  } else if (reference_.apart() && powered()) {
    out.cause = SafetyCause::kImplausible;
    print(out.detail, "%s: motor encoder says %g rad, link encoder %g rad; reference lost: sprung home",
          drive, measured_position_rad(), measured_link_position_rad_);
  } else if (winding_.hot() && powered()) {
    out.cause = SafetyCause::kWinding;
    print(out.detail, "%s: its winding is %.0f %% beyond what its rated current makes it: let it cool", drive,
          100.0 * (winding_.warmth() - 1.0));
  } else if (background_.position_limits().refused()) {
    out.cause = SafetyCause::kDriveRefused;
    print(out.detail, "%s: does not keep its position limits 0x%04X: position_limits_object of robot.yaml",
          drive, actuator_.position_limits_object);
  } else if (modes_.unconfirmed_us() > kModeLimit_us) {
    out.cause = SafetyCause::kDriveFault;
    print(out.detail, "%s: shows mode %d, a second after it was told to switch to %s", drive,
          modes_.display(), sprung::name(modes_.sent()));
  } else {
    return false;
  }
  return true;
}

/// Read once a second: a drive says sooner by an emergency when its supply breaks down.
bool DriveNode::supply_fault(Fault& out) const noexcept {
  const SupplyConfig& range = actuator_.supply;
  const double supply_V = background_.supply_V();
  const bool good = range.max_V <= 0.0 || !(supply_V < range.min_V || supply_V > range.max_V);
  if (good || !powered()) return false;
  out.cause = SafetyCause::kSupply;
  print(out.detail, "%s: supply of %.1f V, robot.yaml allows %.1f to %.1f V", actuator_.name.c_str(),
        supply_V, range.min_V, range.max_V);
  return true;
}

/// Read once a second, which is soon for what warms in minutes.
bool DriveNode::temperature_fault(Fault& out) const noexcept {
  const TemperatureConfig& sensor = actuator_.temperature;
  const double found_degC = background_.temperature_degC();
  if (sensor.reading.index == 0 || !(found_degC > sensor.max_degC) || !powered()) return false;
  out.cause = SafetyCause::kDriveFault;
  print(out.detail, "%s: %.0f degC, robot.yaml allows %.0f degC: let it cool", actuator_.name.c_str(),
        found_degC, sensor.max_degC);
  return true;
}

}  // namespace sprung
