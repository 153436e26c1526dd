#pragma once
/// A robot that hangs on a bench, and the person beside it, both simulated in this process: what `sprung
/// drive commission --sim` and `sprung experiment commission` talk to. The walk sees only frames and answers;
/// the hand alone knows the plant.
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "drivers/canopen/sdo_client.h"
#include "simulation/sim_core.h"
#include "tools/can/commission/drive_port.h"

namespace sprung::commission {

/// Truth that nobody on the bus sees: for the experiment's verdict.
struct BenchTruth {
  /// Of the motor behind its gear, mean of 5 ms: the kHz of a current loop that swings up move no joint.
  double highest_torque_Nm = 0.0;
  double largest_motion_rad = 0.0;  ///< of the joint from where its torque began
  double simulated_s = 0.0;
};

struct BenchSetup {
  int bus = 0;
  int actuator = 0, joint = 0;
  SimOptions sim{};
  double angle_error = 0.0;  ///< of the protractor: a share
  double sling = 1.0;        ///< share of the joint's load that a sling carries: it is to be unloaded
  bool presses_emergency = true;
};

class SimulatedBench final : public DrivePort, public Person {
 public:
  /// @param machine what the drives and the plant truly are. @throws ConfigError.
  SimulatedBench(const RobotConfig& machine, const BenchSetup& setup);

  SdoAnswer read(int node, canopen::ObjectId object) override;
  SdoAnswer write(int node, canopen::ObjectId object, const std::vector<std::uint8_t>& bytes) override;
  void send(const CanFrame& frame) override;
  void beat() override;
  void wait(double seconds) override;
  double now_s() const override { return 1e-6 * static_cast<double>(time_us_); }
  std::vector<int> nodes() override;
  int boot_ups(int node) const override { return boot_ups_[static_cast<std::size_t>(node)]; }
  bool stopped() const override { return stopped_; }

  double answer(const Question& question) override;
  void begins(const std::string& step) override;
  void hears(const std::string& text) override;

  /// Called when a step begins, e.g. to break something in it.
  void on_step(std::function<void(SimulatedBench&, const std::string& step)> what) {
    on_step_ = std::move(what);
  }
  /// Called at the n-th transfer of that step; 0: never.
  void break_at(const std::string& step, int transfer, std::function<void(SimulatedBench&)> how);
  void fault(FaultKind kind, double value, double duration_s);
  void stop() { stopped_ = true; }
  void print_steps(bool on) { prints_ = on; }

  const BenchTruth& truth() const { return truth_; }
  SimCore& sim() { return sim_; }

 private:
  SdoAnswer transfer(canopen::SdoClient& client);
  void advance(std::int64_t us);
  void take_in();
  void watch();
  double mean_torque_Nm(double now_Nm);
  double joint_rad() const;
  void push(double torque_Nm) { sim_.push_joint(setup_.joint, sling_Nm_ + torque_Nm); }
  void turn_joint(double to_rad);

  RobotConfig machine_;
  BenchSetup setup_;
  SimCore sim_;
  std::int64_t time_us_ = 0;
  std::int64_t next_beat_us_ = 0;
  FrameBatch answers_;
  std::vector<CanFrame> heard_;
  std::vector<int> boot_ups_ = std::vector<int>(128, 0);
  BenchTruth truth_;
  bool under_torque_ = false, hand_on_ = false, stopped_ = false, prints_ = false;
  std::deque<std::pair<std::int64_t, double>> torques_;  ///< of the last 5 ms
  double sling_Nm_ = 0.0, torque_from_rad_ = 0.0, turned_from_rad_ = 0.0;
  std::string step_;
  std::function<void(SimulatedBench&, const std::string&)> on_step_;
  std::string break_step_;
  int break_after_ = 0;
  std::function<void(SimulatedBench&)> break_how_;
};

}  // namespace sprung::commission
