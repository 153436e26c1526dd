#include "tools/can/decode/word_texts.h"

#include <cstdio>
#include <utility>

#include "drivers/canopen/emergency.h"
#include "drivers/canopen/objects.h"
#include "drivers/canopen/pdo_words.h"
#include "drivers/cia402/words.h"

namespace sprung::cantools {
namespace {

using canopen::ObjectId;
using Named = std::pair<std::uint32_t, const char*>;

void append(std::string& text, const std::string& more) { text += (text.empty() ? "" : ", ") + more; }

template <std::size_t n>
std::string names_of(std::uint32_t bits, const Named (&names)[n]) {
  std::string text;
  for (const auto& [bit, name] : names) {
    if ((bits & bit) != 0) append(text, name);
  }
  return text;
}

bool in(std::uint16_t index, std::uint16_t first) { return index >= first && index < first + 512; }
bool is_pdo_communication(std::uint16_t index) {
  return in(index, canopen::kRpdoCommunication) || in(index, canopen::kTpdoCommunication);
}
bool is_pdo_mapping(std::uint16_t index) {
  return in(index, canopen::kRpdoMapping) || in(index, canopen::kTpdoMapping);
}

std::string map_entry_text(std::uint32_t word) {
  const canopen::MapEntry entry = canopen::decode_map_entry(word);
  char text[96];
  std::snprintf(text, sizeof text, "0x%04X:%02X %s, %d bit", entry.object.index, entry.object.sub,
                canopen::object_name(entry.object.index), entry.bits);
  return text;
}

std::string cob_id_text(std::uint32_t word) {
  char text[48];
  std::snprintf(text, sizeof text, "id 0x%03X%s", static_cast<unsigned>(word & canopen::kPdoIdMask),
                canopen::pdo_valid(word) ? "" : ", disabled");
  return text;
}

}  // namespace

bool is_code_word(ObjectId id) noexcept {
  switch (id.index) {
    case canopen::kControlWord:
    case canopen::kStatusWord:
    case canopen::kErrorCode:
    case canopen::kErrorRegister:
      return true;
    default:
      return id.index == canopen::kErrorHistory && id.sub != 0;
  }
}

std::string word_meaning(ObjectId id, std::int64_t value) {
  const auto word = static_cast<std::uint32_t>(value);
  if (id.index == canopen::kStatusWord) return status_word_text(static_cast<std::uint16_t>(word));
  if (id.index == canopen::kControlWord) return control_word_text(static_cast<std::uint16_t>(word));
  if (id.index == canopen::kMode || id.index == canopen::kModeDisplay) return mode_text(value);
  if (id.index == canopen::kErrorRegister)
    return canopen::error_register_text(static_cast<std::uint8_t>(word)).data();
  if (id.index == canopen::kErrorCode || (id.index == canopen::kErrorHistory && id.sub != 0))
    return canopen::emergency_text(canopen::history_code(word));
  if (is_pdo_mapping(id.index) && id.sub != 0) return map_entry_text(word);
  if (is_pdo_communication(id.index) && id.sub == 1) return cob_id_text(word);
  return "";
}

std::string status_word_text(std::uint16_t word) {
  // The state's own bits are in its name. 8 and 14 are maxon's (facts canopen 2.2).
  static constexpr Named kBits[] = {{1U << 4, "voltage enabled"}, {1U << 7, "warning"},
                                    {1U << 8, "offset measured"}, {1U << 9, "remote"},
                                    {1U << 10, "target reached"}, {1U << 11, "internal limit"},
                                    {1U << 12, "bit 12"},         {1U << 13, "bit 13"},
                                    {1U << 14, "refresh cycle"},  {1U << 15, "referenced"}};
  std::string text = name(cia402::decode_status(word));
  const std::string bits = names_of(word, kBits);
  return bits.empty() ? text : text + ": " + bits;
}

std::string control_word_text(std::uint16_t word) {
  if ((word & cia402::kFaultResetBit) != 0) return "fault reset";
  switch (word & 0x0F) {
    case cia402::kEnableOperationWord:
      return "enable operation";
    case cia402::kSwitchOnWord:
      return "switch on";
    case cia402::kShutdownWord:
      return "shutdown";
    default:
      break;
  }
  if ((word & 0x02) == 0) return "disable voltage";
  return (word & 0x04) == 0 ? "quick stop" : "shutdown";
}

std::string mode_text(std::int64_t mode) {
  // CiA 402, and maxon's own below zero (facts canopen 2.3 and 3).
  static constexpr std::pair<int, const char*> kModes[] = {{0, "no mode"},
                                                           {1, "profile position"},
                                                           {3, "profile velocity"},
                                                           {4, "profile torque"},
                                                           {6, "homing"},
                                                           {7, "interpolated position"},
                                                           {8, "cyclic position"},
                                                           {9, "cyclic velocity"},
                                                           {10, "cyclic torque"},
                                                           {-1, "position, maxon"},
                                                           {-2, "velocity, maxon"},
                                                           {-3, "current, maxon"},
                                                           {-4, "diagnostic, maxon"},
                                                           {-5, "master encoder, maxon"},
                                                           {-6, "step and direction, maxon"}};
  for (const auto& [code, name] : kModes) {
    if (code == mode) return name;
  }
  return "mode " + std::to_string(mode);
}

std::string error_frame_text(const CanFrame& frame) {
  static constexpr Named kClasses[] = {
      {0x001, "transmit time-out"}, {0x002, "lost arbitration"},
      {0x004, "controller"},        {0x008, "protocol violation"},
      {0x010, "transceiver"},       {0x020, "no acknowledge: nobody else is on the bus"},
      {0x040, "bus off"},           {0x080, "bus error"},
      {0x100, "restarted"},         {0x200, "error counters"}};
  static constexpr Named kController[] = {{0x01, "receive overflow"}, {0x02, "transmit overflow"},
                                          {0x04, "receive warning"},  {0x08, "transmit warning"},
                                          {0x10, "receive passive"},  {0x20, "transmit passive"},
                                          {0x40, "active again"}};
  std::string text = names_of(frame.id, kClasses);
  if ((frame.id & 0x004) != 0) {
    const std::string details = names_of(frame.data[1], kController);
    if (!details.empty()) text += " (" + details + ")";
  }
  if ((frame.id & 0x200) != 0) {
    text += " (transmit " + std::to_string(frame.data[6]) + ", receive " + std::to_string(frame.data[7]) +
            ")";
  }
  return text.empty() ? "error frame without a class" : text;
}

}  // namespace sprung::cantools
