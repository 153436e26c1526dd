#include "tools/lab/campaign/link_tamper.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drivers/canopen/protocol.h"
#include "robots/robot_loader.h"

namespace sprung::campaign {
namespace {

class LinkTamperTest : public testing::Test {
 protected:
  Injection on(Link link, LinkFault fault, double value) {
    Injection out;
    out.kind = Class::kMessage;
    out.link = link;
    out.link_fault = fault;
    out.value = value;
    out.at_seq = 5;
    return out;
  }
  /// @return the numbers of those that arrive, of cycles 0 to 9; -1: lost.
  std::vector<std::int64_t> arrivals(const Injection& injection) {
    LinkTamper tamper(robot_, 1);
    tamper.add(injection);
    std::vector<std::int64_t> out;
    for (std::int64_t seq = 0; seq < 10; ++seq) {
      DriveCommand message(robot_.actuators.size());
      message.stamp.seq = seq;
      tamper.at(seq);
      out.push_back(tamper.pass(message) ? message.stamp.seq : -1);
    }
    return out;
  }
  using Seqs = std::vector<std::int64_t>;
  const RobotConfig robot_ = load_robot("single_leg");
};

TEST_F(LinkTamperTest, MessagesAreLostLateRepeatedOrAheadFromTheirCycleOn) {
  const Link link = Link::kDriveCommand;
  EXPECT_EQ(arrivals(on(link, LinkFault::kLost, 1.0)), (Seqs{0, 1, 2, 3, 4, -1, -1, -1, -1, -1}));
  EXPECT_EQ(arrivals(on(link, LinkFault::kLost, 0.0)), (Seqs{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(arrivals(on(link, LinkFault::kLate, 2)), (Seqs{0, 1, 2, 3, 4, 3, 4, 5, 6, 7}));
  EXPECT_EQ(arrivals(on(link, LinkFault::kRepeated, 0)), (Seqs{0, 1, 2, 3, 4, 5, 5, 5, 5, 5}));
  EXPECT_EQ(arrivals(on(link, LinkFault::kFuture, 3)), (Seqs{0, 1, 2, 3, 4, 8, 9, 10, 11, 12}));
  EXPECT_EQ(arrivals(on(link, LinkFault::kDisorder, 0)), (Seqs{0, 1, 2, 3, 4, 5, 4, 7, 6, 9}));
  EXPECT_EQ(arrivals(on(link, LinkFault::kFlipped, 1.0)), (Seqs{0, 1, 2, 3, 4, -1, -1, -1, -1, -1}));
  EXPECT_EQ(arrivals(on(link, LinkFault::kFlipped, 0.0)), (Seqs{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(arrivals(on(Link::kJointState, LinkFault::kLost, 1.0)), (Seqs{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
}

TEST_F(LinkTamperTest, EveryFieldOfEveryMessageCanBeSpoilt) {
  for (int field = 0; field < fields_of(Link::kDriveCommand); ++field) {
    Injection injection;
    injection.kind = Class::kField;
    injection.link = Link::kDriveCommand;
    injection.field = field;
    injection.target = 1;
    injection.at_seq = 0;
    LinkTamper tamper(robot_, 1);
    tamper.add(injection);
    tamper.at(0);
    DriveCommand message(robot_.actuators.size());
    for (ActuatorCommand& one : message.actuators) one.commanded_position_rad = 1.0;
    EXPECT_TRUE(tamper.pass(message));
    const ActuatorCommand& other = message.actuators[0];
    EXPECT_TRUE(std::isfinite(other.commanded_torque_Nm + other.commanded_position_rad));
    const ActuatorCommand& one = message.actuators[1];
    const double all[] = {one.commanded_torque_Nm, one.commanded_position_rad,
                          one.commanded_damping_Nm_s_rad};
    for (int k = 0; k < 3; ++k) EXPECT_EQ(std::isnan(all[k]), k == field) << field;
  }
}

TEST_F(LinkTamperTest, StrangersSpeakOnTheVictimsBusOnlyInTheirTime) {
  Injection injection;
  injection.kind = Class::kForeign;
  injection.foreign = Foreign::kPreOperational;
  injection.target = 1;
  injection.at_seq = 3;
  injection.duration_s = robot_.cycle_s;
  LinkTamper tamper(robot_, 1);
  tamper.add(injection);
  for (std::int64_t seq = 0; seq < 6; ++seq) {
    FrameBatch frames;
    tamper.at(seq);
    static_cast<InProcessLinks&>(tamper).add_foreign(frames);
    ASSERT_EQ(frames.size(), seq == 3 ? 1 : 0) << seq;
    if (seq != 3) continue;
    EXPECT_EQ(frames[0].frame.id, canopen::kNmtId);
    EXPECT_EQ(frames[0].frame.data[1], robot_.actuators[1].node);
  }
}

}  // namespace
}  // namespace sprung::campaign
