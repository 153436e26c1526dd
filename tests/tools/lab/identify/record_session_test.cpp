#include "tools/lab/identify/record_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <memory>
#include <thread>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/key_source.h"
#include "tests/runtime/lcm_network.h"
#include "tests/support/own_folder.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::identify {
namespace {

constexpr std::int64_t kSession = 7;
constexpr int kJoint = 1;

/// Somebody who publishes JOINT_STATE of a leg whose joints start, and are ready from some cycle on.
class StartingLeg {
 public:
  StartingLeg(const RunInfo& info, const RobotConfig& robot, int ready_from)
      : node_(commanding(info)), thread_([this, robot, ready_from] { run(robot, ready_from); }) {}
  ~StartingLeg() {
    stop_ = true;
    thread_.join();
  }

 private:
  void run(const RobotConfig& robot, int ready_from) {
    Publisher<JointState> out = node_.publisher<JointState>(channels::kJointState);
    JointState state(robot.joints.size(), robot.legs.size());
    state.safety = SafetyLevel::kOperational;
    for (int cycle = 0; !stop_; ++cycle) {
      state.stamp = {100'000 * cycle, cycle};
      for (EstimatedJoint& joint : state.joints) {
        joint.status = cycle < ready_from ? JointStatus::kStarting : JointStatus::kOk;
        joint.estimated_position_rad = 1.0;
      }
      out.publish(state);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  Node node_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

class PlanRecording : public testing::Test {
 protected:
  PlanRecording() {
    setenv("SPRUNG_RUN_DIR", folder_.path().c_str(), 1);
    info_.lcm_url = test::own_lcm_url();
    info_.session = kSession;
    info_.clock = "lockstep";  // this leg's time is that of its cycles
    run_ = std::make_unique<RunFile>(info_.instance);
    run_->write_key(*random_key());
  }
  ~PlanRecording() override {
    run_.reset();
    unsetenv("SPRUNG_RUN_DIR");
  }
  RecordPlan plan(int ready_from) {
    JointMover mover(info_, robot_);
    const StartingLeg leg(info_, robot_, ready_from);
    return plan_recording(robot_, kJoint, {}, mover);
  }
  const test::OwnFolder folder_{"plan-recording"};
  RunInfo info_;
  std::unique_ptr<RunFile> run_;
  const RobotConfig robot_ = load_robot("single_leg");
};

TEST_F(PlanRecording, OfAJointThatIsReady) { EXPECT_FALSE(plan(0).moves.empty()); }

TEST_F(PlanRecording, WaitsForJointsThatAreStarting) { EXPECT_FALSE(plan(4).moves.empty()); }

TEST_F(PlanRecording, RefusesAJointThatGoesOnStarting) {
  try {
    (void)plan(1'000'000);
    FAIL() << "planned with a joint that is not ready";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("is not ready, it is starting"));
  }
}

}  // namespace
}  // namespace sprung::identify
