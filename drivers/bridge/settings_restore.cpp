#include "drivers/bridge/settings_restore.h"

#include "drivers/canopen/nmt.h"

namespace sprung {
namespace {

constexpr std::uint16_t kFirstOutsideCommunication = 0x2000;

}  // namespace

void SettingsRestore::begin(const std::vector<Overwritten>& overwritten) noexcept {
  overwritten_ = &overwritten;
  at_ = 0;
  failed_ = 0;
  done_ = false;
}

bool SettingsRestore::write_next(canopen::SdoClient& sdo) noexcept {
  for (; at_ < overwritten_->size(); ++at_) {
    const DriveSetting& before = (*overwritten_)[at_].setting;
    if (before.object.index < kFirstOutsideCommunication) continue;
    sdo.write(before.object, before.value, before.size);
    ++at_;
    return true;
  }
  return false;
}

bool SettingsRestore::step(std::int64_t time_us, int node, canopen::SdoClient& sdo, CanFrame& out) noexcept {
  if (done_ || !begun()) return false;
  using canopen::SdoStatus;
  if (sdo.status() == SdoStatus::kAborted || sdo.status() == SdoStatus::kTimeout) ++failed_;
  if (sdo.status() != SdoStatus::kBusy) {
    sdo.finish();
    if (!write_next(sdo)) {
      done_ = true;
      out = canopen::nmt_frame(canopen::NmtCommand::kResetCommunication, node);
      return true;
    }
  }
  return sdo.step(time_us, out);
}

}  // namespace sprung
