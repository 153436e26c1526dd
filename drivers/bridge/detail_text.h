#pragma once
/// Sentences for people in the fixed-size text of SAFETY_STATE; no heap.
#include <array>
#include <cstdint>
#include <string>

#include "drivers/profiles/drive_profile.h"

namespace sprung {

using DetailText = std::array<char, 160>;

/// printf into a text; cut where it does not fit.
__attribute__((format(printf, 2, 3))) void print(DetailText& text, const char* format, ...) noexcept;

/// The same behind what is there.
__attribute__((format(printf, 2, 3))) void append(DetailText& text, const char* format, ...) noexcept;

/// "knee_motor: object 0x6072:00 max torque: expected 5571, found 5000"
void print_difference(DetailText& text, const char* drive, const DriveSetting& setting,
                      std::uint32_t found) noexcept;
/// "knee_motor: object 0x6072:00 max torque: refused by the drive (value too high)"
void print_abort(DetailText& text, const char* drive, canopen::ObjectId object,
                 std::uint32_t abort_code) noexcept;

/// A setting's value as these sentences have it. Allocates.
std::string value_text(const DriveSetting& setting);

/// The low `size` bytes of a value.
std::uint32_t low_bytes(std::uint32_t value, int size) noexcept;

}  // namespace sprung
