#pragma once
/// Lines of can-utils' candump: the log format of `candump -L` (which canplayer and log2asc read) both ways,
/// and its plain format in. Pure.
///
///   (1436509052.249713) can0 044#2A366C2B          log format
///   (1436509052.249713) can0 044#2A366C2B T        with candump -x
///    (000.000123)  can0  044   [4]  2A 36 6C 2B    plain, with any of candump's time stamps or none
/// A remote request is 044#R, error frames have 8 digits; T = sent by the machine that logs, R = received.
#include <cstdint>
#include <string>

#include "tools/can/decode/observed_frame.h"

namespace sprung::cantools {

enum class CandumpLine : std::int8_t {
  kFrame,
  kForeign,  ///< a frame, but not a classic one with 11 bit: CAN FD, 29 bit, longer than 8 bytes
  kNothing,  ///< empty line
  kBroken,
};

/// @param interface the line's, e.g. "can0". `frame.bus` stays as it is. Without time stamp: 0 us.
CandumpLine parse_candump(const std::string& line, std::string& interface, ObservedFrame& frame);

/// Log format, without a line's end. @param utc_us microseconds since 1970, or any other beginning, >= 0.
std::string candump_line(const ObservedFrame& frame, const std::string& interface, std::int64_t utc_us);

/// A CAN FD frame the same way, e.g. "(1700000000.000123) can0 123##1DEADBEEF": behind ## 1 = BRS, 2 = ESI.
std::string candump_fd_line(const ObservedFdFrame& observed, const std::string& interface,
                            std::int64_t time_us);

}  // namespace sprung::cantools
