#include "drivers/can/memory_bus.h"

#include <algorithm>
#include <map>

namespace sprung {

std::shared_ptr<MemoryMedium> MemoryMedium::named(const std::string& name) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<MemoryMedium>> media;
  const std::lock_guard<std::mutex> lock(mutex);
  std::shared_ptr<MemoryMedium> medium = media[name].lock();
  if (!medium) {
    medium = std::make_shared<MemoryMedium>(name);
    media[name] = medium;
  }
  return medium;
}

MemoryBus::MemoryBus(std::shared_ptr<MemoryMedium> medium) : medium_(std::move(medium)), ring_(kCapacity) {
  const std::lock_guard<std::mutex> lock(medium_->mutex_);
  medium_->endpoints_.push_back(this);
}

MemoryBus::~MemoryBus() {
  const std::lock_guard<std::mutex> lock(medium_->mutex_);
  auto& endpoints = medium_->endpoints_;
  endpoints.erase(std::remove(endpoints.begin(), endpoints.end(), this), endpoints.end());
}

std::string MemoryBus::describe() const { return "memory:" + medium_->name_; }

void MemoryBus::deliver(const CanFrame& frame) noexcept {
  if (size_ == kCapacity) {
    ++counters_.dropped;
    return;
  }
  ring_[(first_ + size_) % kCapacity] = frame;
  ++size_;
}

bool MemoryBus::send(const CanFrame* frames, int count) noexcept {
  const std::lock_guard<std::mutex> lock(medium_->mutex_);
  for (int i = 0; i < count; ++i) {
    for (MemoryBus* endpoint : medium_->endpoints_) {
      if (endpoint != this) endpoint->deliver(frames[i]);
    }
  }
  counters_.sent += count;
  return true;
}

int MemoryBus::receive(CanFrame* frames, int max) noexcept {
  const std::lock_guard<std::mutex> lock(medium_->mutex_);
  int count = 0;
  while (count < max && size_ > 0) {
    frames[count++] = ring_[first_];
    first_ = (first_ + 1) % kCapacity;
    --size_;
  }
  counters_.received += count;
  return count;
}

}  // namespace sprung
