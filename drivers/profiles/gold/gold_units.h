#pragma once
/// The maker's own objects of an Elmo Gold that sprung uses, shared with the simulated drive ("CANeds Gold
/// V002", product 0x00030923, revision 0x000103F6).
///
/// Position gains are none of them: the data sheet of the CAN firmware names no object for these (0x310C and
/// 0x3113 are known of EtherCAT firmware alone), and 0x2F01, which sprung once wrote, is its user's array.
/// The maker's tool tunes the drive's own loop; or the bridge closes it (position_loop: closed_by: host).
#include <cstdint>

namespace sprung::gold {

/// u16: cycles of 0x60C2 for which a cyclic mode goes on without a new set-point; 1 at default.
inline constexpr std::uint16_t kExtrapolationCycles = 0x2F75;

}  // namespace sprung::gold
