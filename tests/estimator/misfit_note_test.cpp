#include "estimator/misfit_note.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class MisfitNoteTest : public testing::Test {
 protected:
  const std::string* at(std::int64_t utime_us) {
    state_.stamp.utime_us = utime_us;
    return note_.update(state_);
  }
  MisfitReason& reason(std::size_t joint) { return state_.joints[joint].misfit_reason; }

  const RobotConfig robot_ = load_robot("single_leg");
  JointState state_{2, 1};
  MisfitNote note_{robot_};
};

TEST_F(MisfitNoteTest, NothingIsSaidOfModelsThatFitOrAreOnlyDoubted) {
  EXPECT_EQ(at(0), nullptr);
  state_.joints[1].model_fits = false;
  EXPECT_EQ(at(1), nullptr);
  EXPECT_EQ(misfit_note(robot_, state_), "");
}

TEST_F(MisfitNoteTest, JointsAreNamedWithTheirReasonOnceAndTakenBack) {
  reason(1) = MisfitReason::kViscousFriction;
  const std::string* said = at(0);
  ASSERT_NE(said, nullptr);
  EXPECT_EQ(*said, "the model does not fit what moves: knee (viscous friction)");
  EXPECT_EQ(at(2'000'000), nullptr) << "the same";
  reason(0) = MisfitReason::kWeight;
  ASSERT_NE(said = at(3'000'000), nullptr);
  EXPECT_EQ(*said, "the model does not fit what moves: hip (weight), knee (viscous friction)");
  reason(0) = reason(1) = MisfitReason::kNone;
  ASSERT_NE(said = at(5'000'000), nullptr);
  EXPECT_EQ(*said, "");
}

TEST_F(MisfitNoteTest, ChangesAreToldOnceASecondAtMost) {
  reason(1) = MisfitReason::kFriction;
  ASSERT_NE(at(0), nullptr);
  reason(1) = MisfitReason::kInertia;
  EXPECT_EQ(at(999'999), nullptr);
  EXPECT_NE(at(1'000'000), nullptr);
}

}  // namespace
}  // namespace sprung
