#pragma once
/// A real bus, on which this process is the only master. Shell.
#include <array>

#include "drivers/can/can_bus.h"
#include "tools/can/commission/drive_port.h"

namespace sprung::commission {

class LivePort final : public DrivePort {
 public:
  /// @param bus must outlive the port.
  explicit LivePort(CanBus& bus) : bus_(bus) {}

  SdoAnswer read(int node, canopen::ObjectId object) override;
  SdoAnswer write(int node, canopen::ObjectId object, const std::vector<std::uint8_t>& bytes) override;
  void send(const CanFrame& frame) override { bus_.send(&frame, 1); }
  void beat() override;
  void wait(double seconds) override;
  double now_s() const override;
  std::vector<int> nodes() override;
  int boot_ups(int node) const override { return boot_ups_[static_cast<std::size_t>(node)]; }
  bool stopped() const override;

 private:
  SdoAnswer transfer(canopen::SdoClient& client);
  void hear(const CanFrame& frame);

  CanBus& bus_;
  std::array<int, 128> boot_ups_{};
  std::int64_t next_beat_us_ = 0;
};

}  // namespace sprung::commission
