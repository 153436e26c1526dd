/// Says what the robot that `sprung up` runs does and may do: listener [LCM_URL]. Listening needs no key.
///
///   lcm-gen -x --cpp-std=c++11 --cpp-hpath . lcmtypes/*.lcm
///   c++ -std=c++17 -I. examples/operator/listener.cpp -llcm -o listener
#include <cstdio>
#include <lcm/lcm-cpp.hpp>

#include "sprung_msgs/motion_phase_t.hpp"
#include "sprung_msgs/motion_state_t.hpp"
#include "sprung_msgs/safety_state_t.hpp"

namespace {

class Listener {
 public:
  void motion(const lcm::ReceiveBuffer*, const std::string&, const sprung_msgs::motion_state_t* now) {
    const bool stands = now->state == sprung_msgs::motion_phase_t::STANDING;
    if (stands != stood_)
      std::printf("cycle %lld: %s\n", static_cast<long long>(now->seq), stands ? "stands" : "moves");
    stood_ = stands;
  }
  void safety(const lcm::ReceiveBuffer*, const std::string&, const sprung_msgs::safety_state_t* now) {
    if (now->level != level_)
      std::printf("safety: %s, %s\n", now->level_name.c_str(), now->cause_name.c_str());
    level_ = now->level;
  }

 private:
  bool stood_ = false;
  int level_ = -1;
};

}  // namespace

int main(int count, char** words) {
  lcm::LCM network(count > 1 ? words[1] : "udpm://239.255.76.67:7667?ttl=0");
  Listener listener;
  if (!network.good() || network.subscribe("MOTION_STATE", &Listener::motion, &listener) == nullptr ||
      network.subscribe("SAFETY_STATE", &Listener::safety, &listener) == nullptr)
    return 1;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  while (network.handle() == 0) {
  }
}
