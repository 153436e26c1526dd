#pragma once
/// Sends JOINT_STATE and MOTION_STATE on an LCM network of the test's own, 100 times a second, as long as it
/// lives.
#include <atomic>
#include <chrono>
#include <lcm/lcm-cpp.hpp>
#include <string>
#include <thread>

#include "tests/runtime/lcm_network.h"
#include "tests/tools/logs/spy/sample_messages.h"

namespace sprung::test {

class NetworkSender {
 public:
  NetworkSender() : thread_([this] { send(); }) {}
  ~NetworkSender() {
    ends_ = true;
    thread_.join();
  }
  NetworkSender(const NetworkSender&) = delete;
  NetworkSender& operator=(const NetworkSender&) = delete;
  const std::string& url() const { return url_; }

 private:
  void send() {
    lcm::LCM lcm(url_);
    for (std::int64_t seq = 0; !ends_; ++seq) {
      auto joints = joint_state(5 * seq, 40.0 * static_cast<double>(seq % 50) - 1000.0);
      joints.joints[0].gear_output_torque_Nm = 500.0;
      const auto motion = motion_state(5 * seq, static_cast<int>(1 + seq / 30 % 3));
      lcm.publish("JOINT_STATE", &joints);
      lcm.publish("MOTION_STATE", &motion);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  const std::string url_ = own_lcm_url();
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace sprung::test
