#pragma once
/// One decoded frame as a line for people or as a JSON object. Pure.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/can/decode/frame_decoder.h"

namespace sprung::cantools {

/// "   12.345678 leg <- 181 TPDO hip_motor 1: position actual 123 counts = 0.01 rad". @param begin_us that
/// time is counted from.
std::string frame_line(const ObservedFrame& observed, const DecodedFrame& decoded, const std::string& bus,
                       std::int64_t begin_us);

nlohmann::ordered_json frame_json(const ObservedFrame& observed, const DecodedFrame& decoded,
                                  const std::string& bus, std::int64_t begin_us);

/// null where there is none.
nlohmann::ordered_json number_json(const ObjectValue& value);

/// A CAN FD frame: identifier, length, BRS and ESI where they are set, bytes. @param begin_us as above.
std::string fd_frame_line(const ObservedFdFrame& observed, const std::string& bus, std::int64_t begin_us);
nlohmann::ordered_json fd_frame_json(const ObservedFdFrame& observed, const std::string& bus,
                                     std::int64_t begin_us);

}  // namespace sprung::cantools
