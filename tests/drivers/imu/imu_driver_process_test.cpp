/// The real sprung-imu-driver, started as a child, with a pseudo terminal for a sensor and DRIVE_STATEs over
/// LCM.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include "lcmtypes/channels.h"
#include "runtime/node.h"
#include "runtime/process_status.h"
#include "signals/drive_state.h"
#include "signals/sensors.h"
#include "tests/drivers/imu/pty.h"
#include "tests/drivers/imu/xbus_bytes.h"
#include "tests/runtime/child.h"
#include "tests/runtime/lcm_network.h"
#include "tests/support/changed_robot.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

constexpr std::int64_t kImuSession = 815;
constexpr std::int64_t kImuLong_us = 20'000'000;
constexpr std::int64_t kImuCycle_us = 2000;  // of pegasus

class ImuDriverProcess : public testing::Test {
 protected:
  ImuDriverProcess() : node_({url_, kImuSession, 0, {}}) {
    node_.subscribe(channels::kImu, CountLimits::none(), imus_);
    node_.subscribe_message(channels::kProcessStatus, CountLimits::none(), statuses_);
    receiving_ = std::make_unique<Receiving>(node_);
    plug_in();
  }

  void plug_in() { sensor_ = std::make_unique<test::Pty>(); }

  std::vector<std::string> command(const std::string& clock = "realtime") {
    (void)folder_.load(test::replaced(test::shipped_yaml("pegasus"), "imu: true,",
                                      "imu: true, imu_driver: {device: " + sensor_->name() +
                                          ", baud: 460800, mounting: {roll: 0 rad, pitch: 0 rad, yaw: 0 "
                                          "rad}, latency: 0 ms, rate_range: 34 rad/s, "
                                          "force_range: 150 m/s^2, longest_silence: 50 ms},"));
    const std::string yaml = folder_.yaml_path();
    return {test::bin_dir() + "/sprung-imu-driver",
            "--robot",
            yaml.substr(0, yaml.rfind('/')),
            "--session",
            std::to_string(kImuSession),
            "--lcm-url",
            url_,
            "--no-key",
            "--simulation",
            "--clock",
            clock};
  }

  /// A cycle, and with it a message of the sensor. @return whether an IMU like `wanted` came within a while.
  template <class Wanted>
  bool run_until(const Wanted& wanted, bool sends = true) {
    const std::int64_t end_us = node_.utime_us() + kImuLong_us;
    while (node_.utime_us() < end_us) {
      DriveState state(12);
      sent_us_.push_back(node_.utime_us());
      state.stamp = {sent_us_.back(), ++seq_};
      drive_states_.publish(state);
      sample_.counter = static_cast<std::uint16_t>(seq_);
      if (sends) sensor_->write(sample_.bytes());
      node_.wait_for_input(node_.utime_us() + 5'000);
      while (const auto one = statuses_.pop()) status_ = *one;
      (void)imus_.newest(imu_);
      if (wanted()) return true;
    }
    return false;
  }

  /// The driver counts on by its clock from the cycle that it heard last, which may be any: on a busy machine
  /// cycles are late, and so are the ears.
  std::int64_t latest_cycle() const {
    const std::int64_t now_us = node_.utime_us();
    std::int64_t latest = 0;
    for (std::size_t k = 0; k < sent_us_.size(); ++k)
      latest = std::max(latest, static_cast<std::int64_t>(k) + 2 + (now_us - sent_us_[k]) / kImuCycle_us);
    return latest;
  }

  const std::string url_ = test::own_lcm_url();
  test::RobotFolder folder_;
  std::unique_ptr<test::Pty> sensor_;
  Slot<Imu> imus_{Imu{}};
  InputQueue<sprung_msgs::process_status_t> statuses_{1000};
  Node node_;
  std::unique_ptr<Receiving> receiving_;
  Publisher<DriveState> drive_states_ = node_.publisher<DriveState>(channels::kDriveState);
  sprung_msgs::process_status_t status_{};
  test::XbusSample sample_;
  Imu imu_;
  std::int64_t seq_ = 0;
  std::vector<std::int64_t> sent_us_;  ///< when DRIVE_STATE 1, 2, ... were
};

TEST_F(ImuDriverProcess, PublishesWhatTheSensorSaysAndStopsOnRequest) {
  test::Child child(command());
  ASSERT_TRUE(run_until([this] { return imu_.status == ImuStatus::kGood; }));
  EXPECT_NEAR(imu_.measured_specific_force_m_s2[2], 9.81, 1e-5);
  EXPECT_NEAR(imu_.measured_angular_velocity_rad_s[1], 0.2, 1e-6);
  EXPECT_LE(imu_.stamp.seq, latest_cycle());
  ASSERT_TRUE(
      run_until([this] { return status_.state == static_cast<std::int8_t>(ProcessState::kRunning); }));
  EXPECT_EQ(status_.process, "sprung-imu-driver");
  child.signal(SIGTERM);
  EXPECT_EQ(child.wait(), 0);
}

TEST_F(ImuDriverProcess, SensorThatIsUnpluggedIsAFaultAndNoCrash) {
  test::Child child(command());
  ASSERT_TRUE(run_until([this] { return imu_.status == ImuStatus::kGood; }));
  const std::string device = sensor_->name();
  sensor_.reset();
  ASSERT_TRUE(run_until([this] { return imu_.status == ImuStatus::kFault; }, false));
  ASSERT_TRUE(run_until([&] { return status_.detail.find(device + " is gone") != std::string::npos; }, false))
      << status_.detail;
  child.signal(SIGTERM);
  EXPECT_EQ(child.wait(), 0);
}

TEST_F(ImuDriverProcess, SensorThatFallsSilentComesBack) {
  test::Child child(command());
  ASSERT_TRUE(run_until([this] { return imu_.status == ImuStatus::kGood; }));
  ASSERT_TRUE(run_until([this] { return imu_.status == ImuStatus::kFault; }, false));
  ASSERT_TRUE(run_until([this] { return imu_.status == ImuStatus::kGood; }));
  ASSERT_TRUE(run_until([this] { return status_.detail.find("silences ") != std::string::npos; }))
      << status_.detail;
}

TEST_F(ImuDriverProcess, GarbageIsNamed) {
  test::Child child(command());
  const test::Bytes noise(100, 0x5A);
  ASSERT_TRUE(
      run_until([this] { return status_.state == static_cast<std::int8_t>(ProcessState::kReady); }, false));
  ASSERT_TRUE(run_until(
      [&] {
        sensor_->write(noise);
        return status_.detail.find("no message") != std::string::npos;
      },
      false))
      << status_.detail;
}

TEST_F(ImuDriverProcess, WhatCannotWorkIsRefusedAtOnce) {
  EXPECT_NE(test::Child(command("lockstep")).wait(), 0);
  std::vector<std::string> words = command();
  sensor_.reset();
  EXPECT_NE(test::Child(words).wait(), 0) << "no such line";
  (void)folder_.load(test::shipped_yaml("pegasus"));
  EXPECT_NE(test::Child(words).wait(), 0) << "no imu_driver in robot.yaml";
}

}  // namespace
}  // namespace sprung
