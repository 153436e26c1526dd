#pragma once
/// A device in a thread of its own at the other end of a bus, while this lives.
#include <atomic>
#include <functional>
#include <thread>

#include "drivers/can/can_bus.h"

namespace sprung::test {

class DeviceThread {
 public:
  /// @param hears called in that thread with each frame. @param wire outlives this.
  DeviceThread(CanBus& wire, std::function<void(const CanFrame&)> hears)
      : thread_([this, &wire, heard = std::move(hears)] {
          CanFrame frame;
          while (!stop_) {
            if (wire.receive(&frame, 1) == 0) {
              std::this_thread::yield();
            } else {
              heard(frame);
            }
          }
        }) {}
  ~DeviceThread() {
    stop_ = true;
    thread_.join();
  }
  DeviceThread(const DeviceThread&) = delete;
  DeviceThread& operator=(const DeviceThread&) = delete;

 private:
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace sprung::test
