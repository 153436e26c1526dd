#pragma once
/// What the code words of CiA 301 and CiA 402 mean, for people: status and control word, modes, error codes,
/// map entries, COB-IDs. Pure.
#include <cstdint>
#include <string>

#include "drivers/canopen/wire.h"

namespace sprung::cantools {

/// Objects whose value is a pattern of bits or a code, so that hexadecimal says more.
bool is_code_word(canopen::ObjectId id) noexcept;

/// "" where the number speaks for itself.
std::string word_meaning(canopen::ObjectId id, std::int64_t value);

/// "operation enabled, voltage enabled, target reached": state, then the bits that are not the state's own.
std::string status_word_text(std::uint16_t word);
std::string control_word_text(std::uint16_t word);
/// "cyclic torque"; "mode -7" where it is unknown.
std::string mode_text(std::int64_t mode);
/// Of the frame's class bits and details (linux/can/error.h, facts canopen 5): "bus off", "controller: error
/// passive (transmit)".
std::string error_frame_text(const CanFrame& frame);

}  // namespace sprung::cantools
