#pragma once
/// CAN through the kernel (linux/can.h): raw socket, error frames delivered, own frames not.
#include "drivers/can/can_bus.h"

namespace sprung {

class SocketCanBus final : public CanBus {
 public:
  /// @throws std::runtime_error naming the interface and what to do.
  explicit SocketCanBus(const std::string& interface);
  ~SocketCanBus() override;

  bool send(const CanFrame* frames, int count) noexcept override;
  int receive(CanFrame* frames, int max) noexcept override;
  int fd() const noexcept override { return fd_; }
  std::string describe() const override { return "socketcan:" + interface_; }

 private:
  void configure();

  std::string interface_;
  int fd_ = -1;
};

}  // namespace sprung
