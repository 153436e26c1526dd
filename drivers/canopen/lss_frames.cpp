#include "drivers/canopen/lss_frames.h"

#include <cstddef>

namespace sprung::canopen {
namespace {

constexpr int kBitRates_kbit_s[] = {1000, 800, 500, 250, 125,
                                    0,    50,  20,  10};  // CiA 305 table 1; 5 is reserved

CanFrame lss_frame(std::uint32_t id, LssCommand command) noexcept {
  CanFrame frame;
  frame.id = id;
  frame.length = 8;
  frame.data[0] = static_cast<std::uint8_t>(command);
  return frame;
}

bool is_lss(const CanFrame& frame, std::uint32_t id) noexcept {
  return frame.id == id && frame.length == 8 && !frame.remote && !frame.error;
}

}  // namespace

int lss_bit_rate_index(int kbit_s) noexcept {
  for (std::size_t i = 0; i < std::size(kBitRates_kbit_s); ++i) {
    if (kbit_s != 0 && kBitRates_kbit_s[i] == kbit_s) return static_cast<int>(i);
  }
  return -1;
}

int lss_bit_rate_kbit_s(int index) noexcept {
  const bool listed = index >= 0 && index < static_cast<int>(std::size(kBitRates_kbit_s));
  return listed ? kBitRates_kbit_s[index] : 0;
}

CanFrame lss_request(LssCommand command, std::uint8_t byte1, std::uint8_t byte2) noexcept {
  CanFrame frame = lss_frame(kLssMasterId, command);
  frame.data[1] = byte1;
  frame.data[2] = byte2;
  return frame;
}

CanFrame lss_select_request(int part, std::uint32_t number) noexcept {
  const int command = static_cast<int>(LssCommand::kSelectVendor) + part;
  CanFrame frame = lss_frame(kLssMasterId, static_cast<LssCommand>(command));
  put_le(&frame.data[1], number, 4);
  return frame;
}

CanFrame lss_fastscan_request(const LssQuestion& question) noexcept {
  CanFrame frame = lss_frame(kLssMasterId, LssCommand::kFastscan);
  put_le(&frame.data[1], question.number, 4);
  frame.data[5] = static_cast<std::uint8_t>(question.bit);
  frame.data[6] = static_cast<std::uint8_t>(question.part);
  frame.data[7] = static_cast<std::uint8_t>(question.next);
  return frame;
}

LssQuestion decode_lss_question(const CanFrame& request) noexcept {
  return {get_le(&request.data[1], 4), request.data[5], request.data[6], request.data[7]};
}

CanFrame lss_reply(LssCommand command, std::uint32_t value) noexcept {
  CanFrame frame = lss_frame(kLssSlaveId, command);
  put_le(&frame.data[1], value, 4);
  return frame;
}

bool is_lss_request(const CanFrame& frame) noexcept { return is_lss(frame, kLssMasterId); }
bool is_lss_reply(const CanFrame& frame) noexcept { return is_lss(frame, kLssSlaveId); }

const char* lss_text(LssCommand command) noexcept {
  const int number = static_cast<int>(command);
  if (number >= static_cast<int>(LssCommand::kSelectVendor) &&
      number <= static_cast<int>(LssCommand::kSelectSerial))
    return "select by identity";
  if (number >= static_cast<int>(LssCommand::kInquireVendor) &&
      number <= static_cast<int>(LssCommand::kInquireSerial))
    return "inquire identity";
  switch (command) {
    case LssCommand::kSwitchAll:
      return "switch all";
    case LssCommand::kConfigureNode:
      return "configure node id";
    case LssCommand::kConfigureBitRate:
      return "configure bit rate";
    case LssCommand::kActivateBitRate:
      return "activate bit rate";
    case LssCommand::kStore:
      return "store";
    case LssCommand::kSelected:
      return "selected";
    case LssCommand::kIdentified:
      return "identified";
    case LssCommand::kFastscan:
      return "fastscan";
    case LssCommand::kInquireNode:
      return "inquire node id";
    default:
      return "unknown command";
  }
}

}  // namespace sprung::canopen
