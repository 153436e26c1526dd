#pragma once
/// CAN over UDP multicast in python-can's `udp_multicast` format, for machines without CAN. Stays on this
/// machine (ttl 0, loop device). No order, arbitration or delivery is guaranteed by the kernel;
/// drivers/can/lockstep_link.h adds what lock-step needs.
#include <netinet/in.h>

#include <memory>
#include <vector>

#include "drivers/can/can_bus.h"
#include "drivers/can/udp_datagram.h"

namespace sprung {

class UdpBus final : public CanBus {
 public:
  /// @param group IPv4 multicast address, e.g. 239.74.163.2. @throws std::runtime_error when the system
  /// refuses.
  UdpBus(const std::string& group, int port);
  ~UdpBus() override;

  bool send(const CanFrame* frames, int count) noexcept override;
  int receive(CanFrame* frames, int max) noexcept override;
  int receive_timed(CanFrame* frames, std::int64_t* arrival_us, int max) noexcept override;
  int fd() const noexcept override;
  std::string describe() const override;

  bool send_stamped(const StampedFrame* frames, int count) noexcept;
  int receive_stamped(StampedFrame* frames, int max) noexcept;

 private:
  struct Sockets;
  int read_batch(int max) noexcept;
  bool take(int i, StampedFrame& frame) noexcept;

  std::string group_;
  int port_ = 0;
  std::unique_ptr<Sockets> sockets_;
};

}  // namespace sprung
