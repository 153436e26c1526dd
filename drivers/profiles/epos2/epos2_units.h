#pragma once
/// Scales of the EPOS2's own numbers, shared by the bridge's profile and the simulated drive. One rule, the
/// same on both sides; that a real EPOS2's position regulator weighs its gains like this is [unverified]:
/// check on your drive.
///
/// Position mode -1: target 0x2062 in qc (quadrature counts of the motor encoder, 4 for each pulse of
/// 0x2210:01).
///   current_mA = P * 1e-3 * (reference_qc - measured_qc) + D * 1e-5 * (reference_qc_s - measured_qc_s)
/// The reference goes in a straight line to a new target in one period of the drive's 1 kHz loop (0x60C2 is
/// fixed to 1 ms), so D acts on the derivative of the error. P = 0x60FB:01, D = :03; I = :02 is not simulated
/// and must be written 0. From a joint's stiffness [Nm/rad] and damping [Nm s/rad], both at the gear's
/// output, with qc_per_rad = qc of a motor turn * ratio / 2 pi:
///   P = 1e3 * stiffness / (ratio * torque constant) / qc_per_rad / 1e-3
///   D = 1e3 * damping / (ratio * torque constant) / qc_per_rad / 1e-5
/// 0x6065 (maximum following error, qc, default 2000) ends such a soft loop with 0x8611 unless it is raised;
/// 0xFFFFFFFF = never.
#include <cstdint>

namespace sprung::epos2 {

inline constexpr std::int8_t kModeProfilePosition = 1;
inline constexpr std::int8_t kModeProfileVelocity = 3;
inline constexpr std::int8_t kModeVelocity = -2;  ///< set-point 0x206B
inline constexpr std::int8_t kModePosition = -1;  ///< set-point 0x2062
inline constexpr std::int8_t kModeCurrent = -3;   ///< set-point 0x2030

inline constexpr std::uint16_t kCurrentSetting = 0x2030;   ///< i16, mA
inline constexpr std::uint16_t kPositionSetting = 0x2062;  ///< i32, qc
inline constexpr std::uint16_t kEncoderCounter = 0x2020;   ///< u32, qc, wraps
/// U32, qc: 0x2020 at the newest index pulse, 0 before the first.
inline constexpr std::uint16_t kCounterAtIndex = 0x2021;
inline constexpr std::uint16_t kDigitalInputState = 0x2071;  ///< :01, u16, a bit for each functionality
inline constexpr std::uint16_t kMaxFollowingError = 0x6065;  ///< u32, qc
inline constexpr std::uint16_t kPositionLimits = 0x607D;     ///< i32, qc, :01 lowest, :02 highest
inline constexpr std::uint16_t kPositionRegulator = 0x60FB;  ///< i16, :01 P, :02 I, :03 D
inline constexpr std::uint16_t kMotorData = 0x6410;  ///< :01 continuous mA, :02 peak mA, :04 rpm, :05 0.1 s
inline constexpr std::uint16_t kEncoderPulses = 0x2210;  ///< :01, pulses a turn; qc = 4 * pulses

inline constexpr std::uint8_t
    kSensorTypeSub = 2;  ///< of 0x2210; low nibble 1, 2: incremental, with and without index
inline constexpr std::uint8_t kSensorPolaritySub = 4;  ///< of 0x2210; bit 0: encoder 1 counts the other way
inline constexpr std::uint16_t kCurrentRegulator = 0x60F6;  ///< i16, :01 P, :02 I
inline constexpr std::uint16_t
    kMotorType = 0x6402;                          ///< u16: 1 DC, 10 sinusoidal, 11 block (facts canopen 2.4)
inline constexpr std::uint16_t kNodeId = 0x2000;  ///< u8
inline constexpr std::uint16_t
    kBitRateCode = 0x2001;  ///< u16: 0 = 1 M, 1 = 800 k, 2 = 500 k, 3 = 250 k, 4 = 125 kbit/s

inline constexpr double kProportionalUnit_mA_qc = 1e-3;  ///< one count of 0x60FB:01
inline constexpr double kDerivativeUnit_mA_s_qc = 1e-5;  ///< one count of 0x60FB:03
inline constexpr double kThermalUnit_s = 0.1;            ///< one count of 0x6410:05

}  // namespace sprung::epos2
