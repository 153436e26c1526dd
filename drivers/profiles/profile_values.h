#pragma once
/// What the drive profiles share in turning configuration into object values, and set-points into integers.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/canopen/objects.h"
#include "drivers/profiles/drive_profile.h"
#include "signals/angles.h"

namespace sprung::profiles {

/// Rounded to nearest, half away from zero; saturating, since wrapping would reverse a torque. Not a number
/// gives 0.
inline std::int32_t to_integer(double value, double low, double high) noexcept {
  if (std::isnan(value)) return 0;
  return static_cast<std::int32_t>(std::llround(std::clamp(value, low, high)));
}

/// A configuration value in whole units of its object. @throws std::invalid_argument naming `owner`
/// ("actuator 'hip'") and `what` when it is not within 0 and `high`.
inline std::uint32_t to_object(double value, const std::string& owner, const char* what,
                               double high = std::numeric_limits<std::uint32_t>::max()) {
  if (!(value >= 0.0 && std::round(value) <= high)) {
    throw std::invalid_argument(owner + ": " + what + " does not fit the device's object");
  }
  return static_cast<std::uint32_t>(std::llround(value));
}

inline std::string owner(const ActuatorConfig& actuator) { return "actuator '" + actuator.name + "'"; }
inline std::string owner(const EncoderCardConfig& card) { return "encoder card '" + card.name + "'"; }

inline DriveSetting u8(canopen::ObjectId object, std::uint8_t value) { return {object, 1, value, false}; }
inline DriveSetting i8(canopen::ObjectId object, std::int8_t value) {
  return {object, 1, static_cast<std::uint8_t>(value), true};
}
inline DriveSetting u16(canopen::ObjectId object, std::uint32_t value) {
  return {object, 2, value & 0xFFFF, false};
}
inline DriveSetting i16(canopen::ObjectId object, std::int16_t value) {
  return {object, 2, static_cast<std::uint16_t>(value), true};
}
inline DriveSetting u32(canopen::ObjectId object, std::uint32_t value) { return {object, 4, value, false}; }

inline std::int16_t get_i16(const std::uint8_t* bytes) noexcept {
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(canopen::get_le(bytes, 2)));
}
inline std::int32_t get_i32(const std::uint8_t* bytes) noexcept {
  return static_cast<std::int32_t>(canopen::get_le(bytes, 4));
}
inline void put_i16(std::uint8_t* bytes, std::int32_t value) noexcept {
  canopen::put_le(bytes, static_cast<std::uint32_t>(value), 2);
}
inline void put_i32(std::uint8_t* bytes, std::int32_t value) noexcept {
  canopen::put_le(bytes, static_cast<std::uint32_t>(value), 4);
}

/// How the bridge and the node watch each other: two settings, of heartbeats or of node guarding (CiA 301).
/// This one says how often the node is heard: its heartbeat's period, or the guard time. A guarded node may
/// have no 0x1017, so that is not written.
inline DriveSetting heartbeat_producer(const DriveTiming& timing, const std::string& owner) {
  if (timing.guarded)
    return u16({canopen::kGuardTime, 0}, to_object(1e3 * timing.heartbeat_s, owner, "guard time", 0xFFFF));
  return u16({canopen::kHeartbeatProducer, 0},
             to_object(1e3 * timing.heartbeat_s, owner, "heartbeat period", 0xFFFF));
}
/// And this one when the node gives up on the bridge: heartbeat consumer time, or the number of guard times.
inline DriveSetting heartbeat_consumer(const DriveTiming& timing, const std::string& owner) {
  if (timing.guarded) {
    const double factor = std::ceil(timing.heartbeat_consumer_s / timing.heartbeat_s - 1e-9);
    return u8({canopen::kLifeTimeFactor, 0},
              static_cast<std::uint8_t>(to_object(factor, owner, "life time factor", 0xFF)));
  }
  const std::uint32_t ms = to_object(1e3 * timing.heartbeat_consumer_s, owner, "heartbeat consumer time",
                                     0xFFFF);
  return u32({canopen::kHeartbeatConsumer, 1}, (static_cast<std::uint32_t>(canopen::kBridgeNode) << 16) | ms);
}

/// Node guarding in place of heartbeats; a node that sends heartbeats is not guarded (CiA 301), so they go
/// off.
inline std::vector<DriveSetting> guarding_settings(DriveTiming timing, const std::string& owner) {
  timing.guarded = true;
  return {u16({canopen::kHeartbeatProducer, 0}, 0), heartbeat_producer(timing, owner),
          heartbeat_consumer(timing, owner)};
}

}  // namespace sprung::profiles
