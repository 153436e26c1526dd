#include "tools/operate/client/fault_request.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "tests/support/refusal.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class FaultRequestTest : public testing::Test {
 protected:
  SimControl control(const FaultRequest& request) const { return fault_control(robot_, request); }
  std::string refusal(const FaultRequest& request) const {
    return test::refusal_of([&] { control(request); });
  }
  RobotConfig robot_ = load_robot("single_leg");
};

TEST_F(FaultRequestTest, EveryKindThatHasANameHasOneGuide) {
  std::set<FaultKind> guided;
  for (const FaultGuide& guide : fault_guides())
    EXPECT_TRUE(guided.insert(guide.kind).second) << name(guide.kind);
  for (const Word<FaultKind>& word : kWords<FaultKind>) EXPECT_EQ(guided.count(word.value), 1u) << word.name;
}

TEST_F(FaultRequestTest, JointActuatorAndBusAreTargets) {
  EXPECT_EQ(control({"knee", "over-current", {}, 0.0}).actuator, 1);
  EXPECT_EQ(control({"hip_motor", "over-current", {}, 0.0}).actuator, 0);
  const SimControl bus = control({"leg", "bus-off", {}, 0.5});
  EXPECT_EQ(bus.actuator, -1);
  EXPECT_EQ(bus.bus, 0);
  EXPECT_EQ(bus.kind, SimControlKind::kNodeFault);
  EXPECT_EQ(bus.fault, FaultKind::kBusOff);
  EXPECT_DOUBLE_EQ(bus.duration_s, 0.5);
}

TEST_F(FaultRequestTest, ValueIsTheOperatorsOrTheUsualOne) {
  EXPECT_DOUBLE_EQ(control({"knee", "encoder-jump", 0.1, 0.0}).value, 0.1);
  EXPECT_DOUBLE_EQ(control({"knee", "encoder-jump", {}, 0.0}).value,
                   guide_of(FaultKind::kEncoderJump).usual_value);
}

TEST_F(FaultRequestTest, RefusalsSayWhatWouldDo) {
  EXPECT_THAT(refusal({"elbow", "bus-off", {}, 0.0}),
              testing::AllOf(HasSubstr("knee_motor"), HasSubstr("leg (buses)")));
  EXPECT_THAT(refusal({"knee", "queue-full", {}, 0.0}), HasSubstr("name the bus, leg"));
  EXPECT_THAT(refusal({"leg", "over-current", {}, 0.0}), HasSubstr("name a joint or an actuator"));
  EXPECT_THAT(refusal({"knee", "over-current", 3.0, 0.0}), HasSubstr("takes no --value"));
  EXPECT_THAT(refusal({"knee", "fire", {}, 0.0}), HasSubstr("sprung fault --help"));
  EXPECT_THAT(refusal({"knee", "bus-off", {}, -1.0}), HasSubstr("--for"));
  EXPECT_THAT(refusal({"knee", "encoder-jump", 70000.0, 0.0}), HasSubstr("65535 at most"));
  EXPECT_THAT(refusal({"knee", "bus-off", {}, 1e8}), HasSubstr("1e7 s"));
}

TEST_F(FaultRequestTest, AFaultActsAndNoneTakesItAway) {
  FaultRequest request{"knee", "encoder-jump", 0.1, 0.5};
  SimControl made = control(request);
  made.apply_at_seq = 1200;
  EXPECT_EQ(announcement(request, made),
            "encoder-jump at knee, 0.1 rad of the joint: acts at cycle 1200 for 0.5 s");
  EXPECT_THAT(effect_text(made.fault), HasSubstr("it acts now. Watch: implausible samples"));
  request = {"knee", "none", {}, 0.0};
  SimControl mended = control(request);
  mended.apply_at_seq = 1300;
  EXPECT_EQ(announcement(request, mended), "knee: faults that were made there are taken away at cycle 1300");
  EXPECT_EQ(effect_text(mended.fault),
            "taken away. Then: sprung status; if a cause is latched, sprung clear");
  EXPECT_THAT(refusal({"knee", "none", {}, 0.5}), HasSubstr("none takes no --for"));
}

TEST_F(FaultRequestTest, ActuatorsByJointOrName) {
  EXPECT_EQ(actuator_named(robot_, "hip"), 0);
  EXPECT_EQ(actuator_named(robot_, "knee_motor"), 1);
  EXPECT_THROW(actuator_named(robot_, "leg"), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
