// Texts of emergency codes: EPOS2's own codes (facts canopen 2.5) and the classes of CiA 301 table 21.
#include "drivers/canopen/emergency.h"

namespace sprung::canopen {
namespace {

struct CodeText {
  std::uint16_t code;
  const char* text;
};

constexpr CodeText kCodes[] = {
    {0x0000, "no error"},
    {0x1000, "generic error"},
    {0x2310, "over-current"},
    {0x3210, "supply over-voltage"},
    {0x3220, "supply under-voltage"},
    {0x4210, "over-temperature"},
    {0x5113, "logic supply low"},
    {0x5114, "output-stage supply low"},
    {0x6100, "internal software error"},
    {0x6320, "parameter error"},
    {0x7320, "position sensor"},
    {0x8110, "CAN overrun, objects lost"},
    {0x8111, "CAN overrun"},
    {0x8120, "CAN error passive"},
    {0x8130, "life guard or heartbeat lost"},
    {0x8140, "recovered from bus off"},  // CiA 301; not in EPOS2's list
    {0x8150, "transmit identifier collision"},
    {0x81FD, "bus off"},
    {0x81FE, "CAN receive queue overrun"},
    {0x81FF, "CAN transmit queue overrun"},
    {0x8210, "PDO too short"},
    {0x8611, "following error"},
    {0xFF01, "Hall sensor"},
    {0xFF02, "encoder index"},
    {0xFF03, "encoder resolution"},
    {0xFF04, "Hall sensor not found"},
    {0xFF06, "negative limit"},
    {0xFF07, "positive limit"},
    {0xFF08, "Hall angle detection"},
    {0xFF09, "software position limit"},
    {0xFF0A, "position sensor breach"},
    {0xFF0B, "system overloaded"},
    {0xFF0C, "interpolated position mode"},
    {0xFF0D, "auto-tuning identification"},
    {0xFF0F, "gear scaling"},
    {0xFF10, "controller gain"},
    {0xFF11, "main sensor direction"},
    {0xFF12, "auxiliary sensor direction"},
};

/// By the high byte.
constexpr CodeText kClasses[] = {
    {0x21, "current, input side"},
    {0x22, "current, inside"},
    {0x23, "current, output side"},
    {0x31, "mains voltage"},
    {0x32, "voltage, inside"},
    {0x33, "voltage, output side"},
    {0x41, "ambient temperature"},
    {0x42, "device temperature"},
    {0x61, "internal software"},
    {0x62, "user software"},
    {0x63, "data set"},
    {0x81, "communication"},
    {0x82, "protocol error"},
    {0xF0, "additional functions"},
    {0xFF, "device specific"},
};

/// By the upper digit, for all other high bytes.
constexpr const char* kDigits[16] = {
    "no error",    "generic error",   "current",         "voltage",
    "temperature", "device hardware", "device software", "additional modules",
    "monitoring",  "external",        "reserved",        "reserved",
    "reserved",    "reserved",        "reserved",        "additional functions"};

}  // namespace

const char* emergency_text(std::uint16_t code) noexcept {
  for (const CodeText& entry : kCodes) {
    if (entry.code == code) return entry.text;
  }
  for (const CodeText& entry : kClasses) {
    if (entry.code == code >> 8) return entry.text;
  }
  return kDigits[code >> 12];
}

}  // namespace sprung::canopen
