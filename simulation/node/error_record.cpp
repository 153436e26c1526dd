#include "simulation/node/error_record.h"

#include <algorithm>

#include "drivers/canopen/emergency.h"
#include "drivers/canopen/objects.h"

namespace sprung::sim {
namespace {

constexpr std::uint16_t kOverloaded = 0xFF0B;  ///< the one code of FFxx that is of the device profile's class

canopen::ObjectId history(std::int64_t sub) noexcept {
  return {canopen::kErrorHistory, static_cast<std::uint8_t>(sub)};
}

std::uint8_t class_bits(std::uint16_t code) noexcept {
  if (code == kOverloaded) return canopen::kErrorProfile;
  switch (code >> 12) {
    case 0x2:
      return canopen::kErrorCurrent;
    case 0x3:
      return canopen::kErrorVoltage;
    case 0x4:
      return canopen::kErrorTemperature;
    case 0x5:
      return (code >> 8) == 0x51 ? canopen::kErrorVoltage : 0;  // supplies
    case 0x6:
    case 0x7:
      return canopen::kErrorProfile;
    case 0x8:
      return (code >> 8) == 0x86 ? canopen::kErrorProfile
                                 : canopen::kErrorCommunication;  // 86xx: positioning
    case 0xF:
      return canopen::kErrorMaker;
    default:
      return 0;
  }
}

}  // namespace

std::uint8_t register_bits(std::uint16_t code) noexcept {
  return code == 0 ? 0 : static_cast<std::uint8_t>(canopen::kErrorGeneric | class_bits(code));
}

bool ErrorRecord::raise(std::uint16_t code) noexcept {
  if (code == 0 || stands(code)) return false;
  if (count_ == kStanding) std::copy(codes_.begin() + 1, codes_.end(), codes_.begin());
  if (count_ < kStanding) ++count_;
  codes_[count_ - 1] = code;
  push_history(code);
  show();
  return true;
}

bool ErrorRecord::clear(std::uint16_t code) noexcept {
  const auto end = codes_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto kept = std::remove(codes_.begin(), end, code);
  if (kept == end) return false;
  --count_;
  show();
  return count_ == 0;
}

bool ErrorRecord::clear_all() noexcept {
  const bool any = count_ > 0;
  count_ = 0;
  show();
  return any;
}

bool ErrorRecord::stands(std::uint16_t code) const noexcept {
  const auto end = codes_.begin() + static_cast<std::ptrdiff_t>(count_);
  return std::find(codes_.begin(), end, code) != end;
}

std::uint8_t ErrorRecord::error_register() const noexcept {
  std::uint8_t bits = 0;
  for (std::size_t i = 0; i < count_; ++i) bits = static_cast<std::uint8_t>(bits | register_bits(codes_[i]));
  return bits;
}

void ErrorRecord::show() noexcept { dictionary_.set({canopen::kErrorRegister, 0}, error_register()); }

void ErrorRecord::clear_history() noexcept {
  for (std::int64_t sub = 0; dictionary_.has(history(sub)); ++sub) dictionary_.set(history(sub), 0);
}

void ErrorRecord::push_history(std::uint16_t code) noexcept {
  std::int64_t count = dictionary_.get_or(history(0), 0);
  if (dictionary_.has(history(count + 1))) ++count;
  if (count == 0) return;  // this device keeps none
  for (std::int64_t sub = count; sub > 1; --sub)
    dictionary_.set(history(sub), dictionary_.get(history(sub - 1)));
  dictionary_.set(history(1), canopen::encode_history_entry(code));
  dictionary_.set(history(0), count);
}

}  // namespace sprung::sim
