#include "tools/lab/identify/record_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "tests/runtime/lcm_network.h"

namespace sprung::identify {
namespace {

constexpr std::int64_t kSession = 7;
constexpr int kJoint = 1;

/// Somebody who publishes JOINT_STATE of a leg whose joints start, and are ready from some cycle on.
class StartingLeg {
 public:
  StartingLeg(const RunInfo& info, const RobotConfig& robot, int ready_from)
      : node_({info.lcm_url, info.session, 0, {}}),
        thread_([this, robot, ready_from] { run(robot, ready_from); }) {}
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
    info_.lcm_url = test::own_lcm_url();
    info_.session = kSession;
  }
  RecordPlan plan(int ready_from) {
    JointMover mover(info_, robot_);
    const StartingLeg leg(info_, robot_, ready_from);
    return plan_recording(robot_, kJoint, {}, mover);
  }
  RunInfo info_;
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
