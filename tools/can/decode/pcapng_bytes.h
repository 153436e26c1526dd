#pragma once
/// CAN frames as pcapng blocks, for Wireshark: one interface a bus, link type CAN_SOCKETCAN. Pure. Own code,
/// since libpcap reads pcapng but writes only the older pcap, which has no interface names; three kinds of
/// block are all it takes.
///
/// Numbers are in this machine's byte order (little-endian), the CAN identifier is big-endian as the link
/// type demands.
#include <cstdint>
#include <string>

#include "tools/can/decode/observed_frame.h"

namespace sprung::cantools {

/// Begins a file. @param program of whoever writes it.
std::string pcapng_section(const std::string& program);
/// In the order of the buses, before the first frame.
std::string pcapng_interface(const std::string& bus);
/// @param utc_us microseconds since 1970.
std::string pcapng_packet(const ObservedFrame& frame, std::int64_t utc_us);

}  // namespace sprung::cantools
