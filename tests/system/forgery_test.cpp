/// Somebody who hears a robot's network and sends to it, without the run's key.
#include <gtest/gtest.h>
#include <lcm/lcm.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "lcmtypes/channels.h"
#include "runtime/key_source.h"
#include "tests/system/up_fixture.h"
#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/run/separate_run.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

/// Sends forgeries of every channel that moves a robot as soon as it hears a cycle: for that cycle and the
/// next, before the robot's own are there; with and without a key of its own; and all that it heard, again.
class Stranger {
 public:
  Stranger(const RunInfo& run, const RobotConfig& robot)
      : robot_(robot), keyless_(options(run, nullptr)), keyed_(options(run, random_key())) {
    keyless_.on_message<sprung_msgs::drive_state_t>(channels::kDriveState,
                                                    CountLimits::exactly(robot.actuators.size()),
                                                    [this](const sprung_msgs::drive_state_t& state) {
                                                      if (state.actuators.front().fault_code != kForgedFault)
                                                        heard_ = state.seq;
                                                    });
    keyless_.on_message<sprung_msgs::process_status_t>(
        channels::kProcessStatus, CountLimits::none(), [this](const sprung_msgs::process_status_t& status) {
          refused_[status.process] = status.refused_messages;
          if (status.detail.find("forged") != std::string::npos) named_.insert(status.process);
        });
    keyless_.start();
    replaying_.reset(lcm_create(run.lcm_url.c_str()));
    lcm_subscribe(replaying_.get(), "(DRIVE|JOINT)_STATE|(LEG|DRIVE|OPERATOR)_COMMAND|IMU", &overhear, this);
    thread_ = std::thread([this] { attack(); });
  }
  ~Stranger() { stop(); }
  void stop() {
    done_ = true;
    if (thread_.joinable()) thread_.join();
    keyless_.stop();
  }

  std::int64_t sent() const { return sent_; }
  std::int64_t refused(const std::string& process) const {
    const auto found = refused_.find(process);
    return found == refused_.end() ? 0 : found->second;
  }
  bool named(const std::string& process) const { return named_.count(process) > 0; }

 private:
  static constexpr std::int32_t kForgedFault = 4711;  ///< by which it knows its own
  struct Destroy {
    void operator()(lcm_t* lcm) const { lcm_destroy(lcm); }
  };
  static NodeOptions options(const RunInfo& run, std::shared_ptr<const MessageKey> key) {
    NodeOptions options{run.lcm_url, run.session, run.epoch_us, {}};
    options.key = std::move(key);
    return options;
  }
  static void overhear(const lcm_recv_buf_t* buffer, const char* channel, void* self) {
    auto& heard = static_cast<Stranger*>(self)->overheard_[channel];
    const auto* const bytes = static_cast<const std::uint8_t*>(buffer->data);
    if (heard.size() < 50) heard.emplace_back(bytes, bytes + buffer->data_size);
  }

  void attack() {
    for (std::size_t turn = 0; !done_; ++turn) {
      forge(keyless_);
      forge(keyed_);
      while (lcm_handle_timeout(replaying_.get(), 0) > 0) continue;
      for (const auto& [channel, messages] : overheard_) {
        const Bytes& bytes = messages[turn % messages.size()];
        lcm_publish(replaying_.get(), channel.c_str(), bytes.data(), static_cast<unsigned>(bytes.size()));
        ++sent_;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }
  void forge(Node& node) {
    const std::int64_t seq = heard_;
    for (std::int64_t ahead = 0; ahead <= 3; ++ahead) {
      const Stamp stamp{node.utime_us(), seq + ahead};
      send(node, channels::kDriveCommand, full_torque(stamp));
      LegCommand leg(robot_.legs.size());
      leg.stamp = stamp;
      send(node, channels::kLegCommand, leg);
      JointState joints(robot_.joints.size(), robot_.legs.size());
      joints.stamp = stamp;
      send(node, channels::kJointState, joints);
      DriveState drives(robot_.actuators.size());
      drives.stamp = stamp;
      drives.actuators.front().fault_code = kForgedFault;
      send(node, channels::kDriveState, drives);
    }
    OperatorCommand estop;
    estop.stamp = {node.utime_us(), seq};
    estop.request_id = node.utime_us() * 1024;
    estop.kind = OperatorKind::kEstop;
    send(node, channels::kOperatorCommand, estop);
    SimControl push;
    push.stamp = estop.stamp;
    push.kind = SimControlKind::kWrench;
    push.actuator = -1;
    push.wrench = {500.0, 0.0, 0.0};
    push.duration_s = 0.1;
    send(node, channels::kSimControl, push);
  }
  DriveCommand full_torque(const Stamp& stamp) const {
    DriveCommand command(robot_.actuators.size());
    command.stamp = stamp;
    command.valid_until_utime_us = stamp.utime_us + 1'000'000;
    command.used_joint_state_seq = stamp.seq;
    command.used_leg_command_seq = stamp.seq - 1;
    for (ActuatorCommand& actuator : command.actuators) {
      actuator.mode = DriveMode::kTorque;
      actuator.commanded_torque_Nm = 170.0;
    }
    return command;
  }
  template <class Signal>
  void send(Node& node, const char* channel, const Signal& signal) {
    node.publisher<Signal>(channel).publish(signal);
    ++sent_;
  }

  RobotConfig robot_;
  Node keyless_;
  Node keyed_;
  std::unique_ptr<lcm_t, Destroy> replaying_;
  std::map<std::string, std::vector<Bytes>> overheard_;
  std::atomic<std::int64_t> heard_{0};
  std::map<std::string, std::int64_t> refused_;
  std::set<std::string> named_;
  std::int64_t sent_ = 0;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

template <class Signal>
void append_forged(const Signal& signal, Bytes& bytes) {
  MessageOf<Signal> message;
  to_message(signal, 0, message);
  const std::size_t at = bytes.size();
  bytes.resize(at + static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data() + at, 0, message.getEncodedSize());
}

class ForgeryOnTheWire : public SystemTest {
 protected:
  /// All that a cycle says, as bytes.
  static CycleObserver into(std::vector<Bytes>& cycles) {
    return [&cycles](const CycleRecord& cycle) {
      Bytes& bytes = cycles.emplace_back();
      append_forged(cycle.drive_state, bytes);
      append_forged(cycle.joint_state, bytes);
      append_forged(cycle.leg_command, bytes);
      append_forged(cycle.drive_command, bytes);
      append_forged(cycle.truth, bytes);
    };
  }
};

TEST_F(ForgeryOnTheWire, JumpAmongForgeriesHasTheBitsOfAJumpWithout) {
  const RunScript script = jump_script(robot_, "best", SimOptions{3, {}, true}, JumpMode::kHybrid, 1);
  std::vector<Bytes> alone, among;
  run_in_process(script, into(alone), [](const OperatorReply&) {});
  std::unique_ptr<Stranger> stranger;
  SeparateOptions options;
  options.on_ready = [&](const RunInfo& run) { stranger = std::make_unique<Stranger>(run, robot_); };
  run_separate(
      script, into(among), [](const OperatorReply&) {}, options);
  stranger->stop();
  RecordProperty("sent", static_cast<int>(stranger->sent()));
  EXPECT_GT(stranger->sent(), 1'000);
  for (const char* process : {"sprung-leg-controller", "sprung-motion-planner", "sprung-torque-estimator",
                              "sprung-can-bridge", "sprung-sim-drives"}) {
    EXPECT_GT(stranger->refused(process), 50) << process;
    EXPECT_TRUE(stranger->named(process)) << process;
  }
  ASSERT_EQ(alone.size(), among.size());
  for (std::size_t k = 0; k < alone.size(); ++k)
    ASSERT_EQ(alone[k], among[k]) << "differs first in cycle " << k;
}

class KeyOfARun : public Up {
 protected:
  static bool holds(const std::string& text, const std::string& key) {
    std::string digits;
    for (const char c : key) {
      char two[3];
      std::snprintf(two, sizeof two, "%02x", static_cast<unsigned char>(c));
      digits += two;
    }
    return text.find(key) != std::string::npos || text.find(digits) != std::string::npos;
  }
};

TEST_F(KeyOfARun, IsInNoCommandLineEnvironmentLogOrRunFile) {
  log_folder_ = folder_ / "logs";
  up("lockstep", "--speed 5");
  ASSERT_EQ(sprung("stand").status, 0);
  const std::string key = read_all(run_key_path("default"));
  ASSERT_EQ(key.size(), kKeyBytes);
  EXPECT_EQ(fs::status(run_key_path("default")).permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  const RunInfo run = info();
  std::vector<std::int64_t> pids{run.launcher_pid};
  for (const RunningProcess& process : run.processes) pids.push_back(process.pid);
  ASSERT_GE(pids.size(), 6u);
  for (const std::int64_t pid : pids) {
    const std::string process = "/proc/" + std::to_string(pid);
    EXPECT_FALSE(holds(read_all(process + "/cmdline"), key));
    EXPECT_FALSE(holds(read_all(process + "/environ"), key));
  }
  EXPECT_FALSE(holds(read_all(run_file_path("default")), key));
  const std::string said_by_up = said();
  EXPECT_EQ(sprung("down").status, 0);
  EXPECT_EQ(wait_for_up(), 0);
  EXPECT_FALSE(fs::exists(run_key_path("default"))) << "it ends with the run";
  EXPECT_FALSE(holds(said_by_up, key));
  for (const auto& file : fs::directory_iterator(log_folder_))
    EXPECT_FALSE(holds(read_all(file.path()), key));
}

TEST_F(KeyOfARun, IsHandedToAProgramOfOnesOwn) {
  up("lockstep", "--speed 5");
  const CommandResult own = sprung(
      "run -- sh -c 'dd bs=64 count=1 status=none <&$SPRUNG_KEY_FD | wc -c; "
      "echo $SPRUNG_LCM_URL; exit 3'");
  EXPECT_EQ(own.status, 3) << own.output;
  EXPECT_EQ(own.output, "32\n" + lcm_url() + "\n");
  const CommandResult missing = sprung("run -- /nowhere");
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.output.find("cannot start /nowhere"), std::string::npos) << missing.output;
}

TEST_F(KeyOfARun, IsNeededToCommandAndNotToLook) {
  up("lockstep", "--speed 5");
  fs::permissions(run_key_path("default"), fs::perms::others_read, fs::perm_options::add);
  const CommandResult stand = sprung("stand");
  EXPECT_EQ(stand.status, 1);
  EXPECT_NE(stand.output.find("chmod 600"), std::string::npos) << stand.output;
  EXPECT_EQ(sprung("status").status, 0);
  fs::permissions(run_key_path("default"), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(sprung("stand").status, 0);
}

}  // namespace
}  // namespace sprung
