#include "simulation/bus_faults.h"

#include "drivers/can/can_errors.h"

namespace sprung::sim {
namespace {

constexpr std::uint8_t kActiveAgain = 0x40;  ///< detail of a controller error (linux/can/error.h)

CanFrame error_frame(std::uint32_t error_class, std::uint8_t controller_detail = 0) noexcept {
  CanFrame frame;
  frame.id = error_class;
  frame.length = 8;
  frame.data[1] = controller_detail;
  frame.error = true;
  return frame;
}

}  // namespace

void BusFaults::set(int bus, FaultKind kind, bool on) noexcept {
  if (bus < 0 || bus >= static_cast<int>(full_.size())) return;
  if (kind == FaultKind::kBusOff) tell(bus, on ? bus_lost_frame() : error_frame(kCanErrorRestarted));
  if (kind == FaultKind::kErrorPassive)
    tell(bus, error_frame(kCanErrorController, on ? kControllerPassive : kActiveAgain));
  if (kind == FaultKind::kQueueFull) full_[index(bus)] = on;
  if (kind == FaultKind::kLinkDown) down_[index(bus)] = on;
}

void BusFaults::sync(int bus) noexcept {
  if (full_[index(bus)]) tell(bus, queue_full_frame());
  if (down_[index(bus)]) tell(bus, link_down_frame());
}

void BusFaults::tell(int bus, const CanFrame& error) noexcept {
  if (count_ < kCapacity) waiting_[count_++] = {bus, error};
}

void BusFaults::report(FrameBatch& out) noexcept {
  for (std::size_t i = 0; i < count_; ++i) out.push(waiting_[i].bus, waiting_[i].frame);
  count_ = 0;
}

}  // namespace sprung::sim
