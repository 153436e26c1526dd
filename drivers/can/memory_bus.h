#pragma once
/// CAN within one process: every endpoint of a medium sees the frames of all others, in the order of sending.
#include <memory>
#include <mutex>
#include <vector>

#include "drivers/can/can_bus.h"

namespace sprung {

class MemoryMedium;

class MemoryBus final : public CanBus {
 public:
  explicit MemoryBus(std::shared_ptr<MemoryMedium> medium);
  ~MemoryBus() override;
  bool send(const CanFrame* frames, int count) noexcept override;
  int receive(CanFrame* frames, int max) noexcept override;
  int fd() const noexcept override { return -1; }
  std::string describe() const override;

 private:
  friend class MemoryMedium;
  static constexpr std::size_t kCapacity = 4096;
  void deliver(const CanFrame& frame) noexcept;

  std::shared_ptr<MemoryMedium> medium_;
  std::vector<CanFrame> ring_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

/// Endpoints may live in different threads.
class MemoryMedium {
 public:
  explicit MemoryMedium(std::string name) : name_(std::move(name)) {}
  /// The medium of this name in this process; lives as long as an endpoint of it.
  static std::shared_ptr<MemoryMedium> named(const std::string& name);

 private:
  friend class MemoryBus;
  std::string name_;
  std::mutex mutex_;
  std::vector<MemoryBus*> endpoints_;
};

}  // namespace sprung
