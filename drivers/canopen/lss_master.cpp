#include "drivers/canopen/lss_master.h"

namespace sprung::canopen {
namespace {

constexpr int kParts = 4;
constexpr int kHighestBit = 31;

constexpr bool has_error_code(LssCommand command) noexcept {
  return command == LssCommand::kConfigureNode || command == LssCommand::kConfigureBitRate ||
         command == LssCommand::kStore;
}

}  // namespace

void LssMaster::begin(const CanFrame& request, LssCommand reply) noexcept {
  requests_[0] = request;
  count_ = 1;
  sent_ = 0;
  status_ = LssStatus::kBusy;
  value_ = 0;
  replies_ = true;
  reply_ = reply;
  takes_error_ = has_error_code(reply);
  scanning_ = false;
  heard_ = false;
}

void LssMaster::begin_silent(const CanFrame& request) noexcept {
  begin(request, lss_command(request));
  replies_ = false;
}

void LssMaster::switch_all(LssMode mode) noexcept {
  begin_silent(lss_request(LssCommand::kSwitchAll, static_cast<std::uint8_t>(mode)));
}

void LssMaster::select(const LssIdentity& identity) noexcept {
  begin(lss_select_request(0, identity[0]), LssCommand::kSelected);
  for (count_ = 1; count_ < identity.size(); ++count_)
    requests_[count_] = lss_select_request(static_cast<int>(count_), identity[count_]);
}

void LssMaster::inquire(int part) noexcept {
  const auto command = static_cast<LssCommand>(static_cast<int>(LssCommand::kInquireVendor) + part);
  begin(lss_request(command), command);
}

void LssMaster::inquire_node() noexcept {
  begin(lss_request(LssCommand::kInquireNode), LssCommand::kInquireNode);
}

void LssMaster::configure_node(int node) noexcept {
  begin(lss_request(LssCommand::kConfigureNode, static_cast<std::uint8_t>(node)), LssCommand::kConfigureNode);
}

void LssMaster::configure_bit_rate(int index) noexcept {
  begin(lss_request(LssCommand::kConfigureBitRate, 0, static_cast<std::uint8_t>(index)),
        LssCommand::kConfigureBitRate);
}

void LssMaster::activate_bit_rate(std::uint16_t delay_ms) noexcept {
  begin_silent(lss_request(LssCommand::kActivateBitRate, static_cast<std::uint8_t>(delay_ms & 0xFF),
                           static_cast<std::uint8_t>(delay_ms >> 8)));
}

void LssMaster::store() noexcept { begin(lss_request(LssCommand::kStore), LssCommand::kStore); }

void LssMaster::fastscan() noexcept {
  question_ = {};
  identity_ = {};
  ask();
}

void LssMaster::ask() noexcept {
  begin(lss_fastscan_request(question_), LssCommand::kIdentified);
  scanning_ = true;
}

bool LssMaster::step(std::int64_t time_us, CanFrame& request) noexcept {
  if (status_ != LssStatus::kBusy) return false;
  if (scanning_ && sent_ == count_ && time_us - sent_us_ >= question_us_) answered(heard_);
  if (status_ != LssStatus::kBusy) return false;
  if (sent_ < count_) {
    request = requests_[sent_++];
    sent_us_ = time_us;
    if (sent_ == count_ && !replies_) status_ = LssStatus::kDone;
    return true;
  }
  if (!scanning_ && time_us - sent_us_ >= timeout_us_) status_ = LssStatus::kTimeout;
  return false;
}

void LssMaster::receive(const CanFrame& frame) noexcept {
  if (status_ != LssStatus::kBusy || sent_ < count_ || !is_lss_reply(frame)) return;
  if (lss_command(frame) != reply_) return;
  heard_ = true;
  if (scanning_) return;  // others may say the same: the question ends with its time
  value_ = get_le(&frame.data[1], takes_error_ ? 2 : 4);
  if (reply_ == LssCommand::kInquireNode) value_ &= 0xFF;
  status_ = takes_error_ && error() != 0 ? LssStatus::kRefused : LssStatus::kDone;
}

/// A question of the fastscan is over.
void LssMaster::answered(bool yes) noexcept {
  if (question_.bit == LssQuestion::kAnyone) {
    if (!yes) {
      status_ = LssStatus::kNobody;
      return;
    }
    question_ = {0, kHighestBit, 0, 0};
    return ask();
  }
  question_.next == question_.part ? next_bit(yes) : next_part(yes);
}

/// Silence: the bit that was asked as 0 is 1. After the last bit the number as a whole is confirmed.
void LssMaster::next_bit(bool yes) noexcept {
  if (!yes) question_.number |= 1U << question_.bit;
  if (question_.bit > 0) {
    --question_.bit;
  } else {
    question_.next = (question_.part + 1) % kParts;
  }
  ask();
}

void LssMaster::next_part(bool yes) noexcept {
  if (!yes) {
    status_ = LssStatus::kTimeout;
    return;
  }
  identity_[static_cast<std::size_t>(question_.part)] = question_.number;
  if (question_.next == 0) {
    status_ = LssStatus::kDone;
    return;
  }
  question_ = {0, kHighestBit, question_.next, question_.next};
  ask();
}

}  // namespace sprung::canopen
