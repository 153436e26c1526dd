/// What a drive is compared with, and objects as people type them: drive_check.h, object_lookup.h.
#include "tools/can/decode/drive_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "drivers/bridge/boot_script.h"
#include "robots/robot_loader.h"
#include "tests/support/refusal.h"
#include "tools/can/decode/object_lookup.h"

namespace sprung::cantools {
namespace {

using testing::HasSubstr;

std::uint32_t key(canopen::ObjectId object) {
  return static_cast<std::uint32_t>(object.index) << 8 | object.sub;
}

/// The bridge's own script is the judge: what it leaves in a node is what is expected of it.
TEST(DriveCheck, ExpectsWhatTheBridgeWrites) {
  for (const char* name : {"single_leg", "pegasus"}) {
    const RobotConfig robot = load_robot(name);
    const DriveTiming timing = drive_timing(robot, robot.watchdogs);
    for (const NodeDescription& node : describe_buses(robot).nodes) {
      const IdentityConfig& identity = node.actuator ? node.actuator->identity : node.encoder_card->identity;
      std::map<std::uint32_t, std::uint32_t> written;
      for (const BootStep& step :
           make_boot_script(identity, *node_profile(node, timing), node.node, node.actuator.has_value())) {
        const bool checked = step.kind == BootStep::Kind::kVerify || step.kind == BootStep::Kind::kAdopt ||
                             step.kind == BootStep::Kind::kWriteAndVerify;
        if (checked) written[key(step.setting.object)] = step.setting.value;
      }
      const auto expected = expected_objects(node, timing);
      EXPECT_EQ(expected.size(), written.size()) << node.name;
      for (const ExpectedObject& object : expected) {
        ASSERT_EQ(written.count(key(object.object)), 1u)
            << node.name << " " << canopen::id_text(object.object);
        EXPECT_TRUE(matches(object, written[key(object.object)]))
            << node.name << " " << canopen::id_text(object.object);
      }
    }
  }
}

TEST(DriveCheck, OfADisabledPdoOnlyThatItIsOffCounts) {
  const ExpectedObject off{{0x1802, 1}, 4, 0x80000381, false, canopen::kPdoInvalid};
  EXPECT_TRUE(matches(off, 0xC0000399));
  EXPECT_FALSE(matches(off, 0x40000381));
}

TEST(DriveCheck, AnyOtherBitCounts) {
  const ExpectedObject limit{{0x6072, 0}, 2, 1000, false, 0xFFFFFFFF};
  EXPECT_TRUE(matches(limit, 1000));
  EXPECT_FALSE(matches(limit, 1001));
}

class ObjectLookup : public testing::Test {
 protected:
  std::string refusal(const std::string& text, const canopen::Eds* eds) const {
    return test::refusal_of([&] { find_object(text, eds); });
  }
  BusDescription robot_ = describe_buses(load_robot("single_leg"));
  const canopen::Eds* eds_ = robot_.nodes[0].eds.get();
};

TEST_F(ObjectLookup, NumbersAreHexadecimalWithOrWithoutPrefix) {
  EXPECT_EQ(find_object("0x6064", nullptr), (canopen::ObjectId{0x6064, 0}));
  EXPECT_EQ(find_object("6410:0a", nullptr), (canopen::ObjectId{0x6410, 10}));
  EXPECT_EQ(find_object("0X2F01:1", nullptr), (canopen::ObjectId{0x2F01, 1}));
}

TEST_F(ObjectLookup, NamesMayBeShortenedToWhatOnlyOneHas) {
  EXPECT_EQ(find_object("Position Actual", eds_),
            (canopen::ObjectId{0x6064, 0}));  // though 0x6063 has it as a part
  EXPECT_EQ(find_object("extrapolation", eds_), (canopen::ObjectId{0x2F75, 0}));
}

TEST_F(ObjectLookup, SeveralOrNoneAreExplained) {
  EXPECT_THAT(refusal("position", eds_), testing::AllOf(HasSubstr("0x6064:00"), HasSubstr("0x607A:00")));
  EXPECT_THAT(refusal("warp factor", eds_), HasSubstr("not in the EDS of Gold"));
  EXPECT_THAT(refusal("position", nullptr), HasSubstr("has no EDS"));
  EXPECT_THAT(refusal("6064:", eds_), HasSubstr("not in the EDS"));
}

}  // namespace
}  // namespace sprung::cantools
