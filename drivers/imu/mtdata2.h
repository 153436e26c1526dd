#pragma once
/// What an Xsens MTi measures, from an MTData2 message (0x36): packets of a data identifier, a length and
/// numbers, most significant byte first (public "MT Low Level Communication Protocol Documentation"). Pure.
///
/// An identifier's lowest two bits say the numbers' format (0 float32, 1 fixed 12.20, 2 fixed 16.32,
/// 3 float64), the two above them the axes of the world: 0 x east, y north, z up; 4 x north, y east, z down;
/// 8 x north, y west, z up. What is not listed here is skipped.
///
/// Not verified on a sensor: fixed 16.32 has its fraction first, then the whole part; the bits of the status
/// word; that 0x4020 is specific force, +9.81 up at rest.
#include <array>
#include <cstddef>
#include <cstdint>

namespace sprung::imu {

inline constexpr std::uint8_t kMtData2 = 0x36;

struct MtData2 {
  bool has_counter = false, has_time = false, has_rate = false, has_force = false, has_quaternion = false,
       has_status = false;
  std::uint16_t counter = 0;                ///< 1020: goes up by one with each message
  std::uint32_t time_100us = 0;             ///< 1060: of the sensor's clock
  std::array<double, 3> rate_rad_s{};       ///< 8020: sensor axes
  std::array<double, 3> force_m_s2{};       ///< 4020: sensor axes, gravity included
  std::array<double, 4> quaternion_wxyz{};  ///< 2010: sensor axes to world axes
  bool world_is_down = false;               ///< the quaternion's world has its z axis down
  std::uint32_t status = 0;                 ///< E020
};

// Of the status word.
inline constexpr std::uint32_t kStatusFilterValid = 1U << 1;
inline constexpr std::uint32_t kStatusClippedForce = 7U << 8;
inline constexpr std::uint32_t kStatusClippedRate = 7U << 11;

/// @return false where packets do not fit into the message, or one has a length that its identifier cannot
/// have: then nothing of it can be believed.
bool decode_mtdata2(const std::uint8_t* data, std::size_t size, MtData2& out) noexcept;

}  // namespace sprung::imu
