#include "simulation/node/lss_slave.h"

#include "drivers/canopen/objects.h"

namespace sprung::sim {
namespace {

using canopen::LssCommand;
using canopen::LssMode;

constexpr std::uint32_t kOutOfRange = 1;  ///< error code of CiA 305, for node id and bit rate alike
constexpr int kParts = 4;

LssSlave::Answer reply(LssCommand command, std::uint32_t value = 0) noexcept {
  return {true, canopen::lss_reply(command, value), false};
}

int part_of(LssCommand command, LssCommand first) noexcept {
  return static_cast<int>(command) - static_cast<int>(first);
}

bool is_part(int part) noexcept { return part >= 0 && part < kParts; }

}  // namespace

LssSlave::LssSlave(const ObjectDictionary& dictionary, bool offered, int node) noexcept
    : dictionary_(dictionary), offered_(offered), node_(node), pending_(node), stored_(node) {}

void LssSlave::restart() noexcept {
  node_ = pending_ = stored_;
  bit_rate_ = stored_bit_rate_;
  mode_ = LssMode::kWaiting;
  selected_ = 0;
}

std::uint32_t LssSlave::identity(int part) const noexcept {
  const canopen::ObjectId object{canopen::kIdentity, static_cast<std::uint8_t>(part + 1)};
  return static_cast<std::uint32_t>(dictionary_.get_or(object, 0));
}

LssSlave::Answer LssSlave::receive(const CanFrame& frame) noexcept {
  if (!offered_ || !canopen::is_lss_request(frame)) return {};
  const LssCommand command = canopen::lss_command(frame);
  if (command == LssCommand::kSwitchAll) return switch_mode(static_cast<LssMode>(frame.data[1]));
  if (command == LssCommand::kFastscan) return identify(canopen::decode_lss_question(frame));
  const int part = part_of(command, LssCommand::kSelectVendor);
  if (is_part(part)) return select(part, canopen::get_le(&frame.data[1], 4));
  return mode_ == LssMode::kConfiguration ? configure(frame) : Answer{};
}

LssSlave::Answer LssSlave::configure(const CanFrame& frame) noexcept {
  const LssCommand command = canopen::lss_command(frame);
  const int part = part_of(command, LssCommand::kInquireVendor);
  if (is_part(part)) return inquire(part);
  switch (command) {
    case LssCommand::kInquireNode:
      return reply(command, static_cast<std::uint32_t>(node_));
    case LssCommand::kConfigureNode:
      return reply(command, set_node(frame.data[1]));
    case LssCommand::kConfigureBitRate:
      return reply(command, set_bit_rate(frame.data[1], frame.data[2]));
    case LssCommand::kStore:
      stored_ = pending_;
      stored_bit_rate_ = bit_rate_;
      return reply(command);
    default:
      return {};
  }
}

LssSlave::Answer LssSlave::switch_mode(LssMode mode) noexcept {
  selected_ = 0;
  if (mode != LssMode::kWaiting && mode != LssMode::kConfiguration) return {};
  const bool wakes = mode == LssMode::kWaiting && mode_ == LssMode::kConfiguration && !has_node() &&
                     pending_ != canopen::kNoNode;
  mode_ = mode;
  if (wakes) node_ = pending_;
  return {false, {}, wakes};
}

/// The four numbers must come in order, and all be right.
LssSlave::Answer LssSlave::select(int part, std::uint32_t number) noexcept {
  const bool right = mode_ == LssMode::kWaiting && (part == 0 || part == selected_) &&
                     number == identity(part);
  selected_ = right ? part + 1 : 0;
  if (selected_ < kParts) return {};
  selected_ = 0;
  mode_ = LssMode::kConfiguration;
  return reply(LssCommand::kSelected);
}

/// Only those answer that have no node id, now or configured.
LssSlave::Answer LssSlave::identify(const canopen::LssQuestion& question) noexcept {
  if (has_node() || pending_ != canopen::kNoNode || mode_ != LssMode::kWaiting) return {};
  if (question.bit == canopen::LssQuestion::kAnyone) {
    scanned_ = 0;
    return reply(LssCommand::kIdentified);
  }
  if (question.bit > 31 || question.part != scanned_ || !is_part(question.part) || !is_part(question.next))
    return {};
  if ((identity(question.part) >> question.bit) != (question.number >> question.bit)) return {};
  scanned_ = question.next;
  if (question.bit == 0 && question.next < question.part) mode_ = LssMode::kConfiguration;
  return reply(LssCommand::kIdentified);
}

LssSlave::Answer LssSlave::inquire(int part) const noexcept {
  const int command = static_cast<int>(LssCommand::kInquireVendor) + part;
  return reply(static_cast<LssCommand>(command), identity(part));
}

std::uint32_t LssSlave::set_node(int node) noexcept {
  const bool valid = (node >= 1 && node <= canopen::kMaxNode) || node == canopen::kNoNode;
  if (!valid) return kOutOfRange;
  pending_ = node;
  return 0;
}

std::uint32_t LssSlave::set_bit_rate(int table, int index) noexcept {
  if (table != 0 || canopen::lss_bit_rate_kbit_s(index) == 0) return kOutOfRange;
  bit_rate_ = index;
  return 0;
}

}  // namespace sprung::sim
