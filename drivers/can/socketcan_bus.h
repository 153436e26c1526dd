#pragma once
/// CAN through the kernel (linux/can.h, facts canopen 5): raw socket, error frames delivered. Own frames come
/// back from the bus as confirmations: they are counted and timed, and never received. An interface that goes
/// down and up again, or is unplugged and comes back under its name, works again without reopening.
#include <deque>
#include <memory>
#include <vector>

#include "drivers/can/can_bus.h"

namespace sprung {

class SocketCanBus final : public CanBus {
 public:
  /// @param hears_fd CAN FD frames of others too: for receive_fd(). Never changes what receive() gives.
  /// @throws std::runtime_error naming the interface and what to do; also where `hears_fd` and the interface
  /// is a classic one.
  explicit SocketCanBus(const std::string& interface, bool hears_fd = false);
  ~SocketCanBus() override;

  bool send(const CanFrame* frames, int count) noexcept override;
  int receive(CanFrame* frames, int max) noexcept override;
  /// Kernel's software stamps: a CAN controller's own clock, where it has one, is not CLOCK_MONOTONIC.
  int receive_timed(CanFrame* frames, std::int64_t* arrival_us, int max) noexcept override;
  int receive_fd(CanFdFrame* frames, int max) noexcept override;
  bool accept_only(const CanFilter* filters, int count) override;
  int fd() const noexcept override;
  std::string describe() const override { return "socketcan:" + interface_ + (hears_fd_ ? "?fd=1" : ""); }

 private:
  struct Socket;
  void configure();
  void ask_for_fd();
  bool bind_interface() noexcept;
  bool set_filters() noexcept;
  int send_batch(const CanFrame* frames, int count) noexcept;
  bool worth_another_try(int error) noexcept;
  void count_failure(int error, int frames) noexcept;
  int read_batch(int max) noexcept;
  bool take(int i, CanFrame& frame, std::int64_t& arrival_us) noexcept;
  void count_confirmation(const CanFrame& frame, std::int64_t arrival_us) noexcept;

  std::string interface_;
  bool hears_fd_;
  std::deque<CanFdFrame> fd_frames_;  ///< not fetched yet
  std::vector<CanFilter> filters_;
  std::unique_ptr<Socket> socket_;
};

}  // namespace sprung
