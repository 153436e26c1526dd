#pragma once
/// Where a simulated device puts its frames.
#include "drivers/can/can_frame.h"

namespace sprung::sim {

class Outbox {
 public:
  explicit Outbox(int bus) noexcept : bus_(bus) {}
  /// Frames go here from now on; nullptr = they are lost.
  void open(FrameBatch* batch) noexcept { batch_ = batch; }
  /// A cut cable: nothing goes out.
  void set_cut(bool cut) noexcept { cut_ = cut; }
  bool cut() const noexcept { return cut_; }
  void send(const CanFrame& frame) noexcept {
    if (batch_ != nullptr && !cut_) batch_->push(bus_, frame);
  }

 private:
  int bus_;
  bool cut_ = false;
  FrameBatch* batch_ = nullptr;
};

}  // namespace sprung::sim
