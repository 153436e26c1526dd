#include "tools/station/frames/version_notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/tools/logs/log/robot_sample.h"

namespace sprung::station {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class VersionNotesTest : public testing::Test {
 protected:
  void add(log::Kept event, bool other_version) {
    if (other_version) event.data[0] ^= 0x55;
    frames_.add(event.channel, reinterpret_cast<const std::uint8_t*>(event.data.data()), event.data.size(),
                0);
  }
  Frames frames_{load_robot("single_leg")};
};

TEST_F(VersionNotesTest, NothingIsSaidOfWhatIsRead) {
  add(log::joint_event(0), false);
  EXPECT_THAT(version_notes(frames_, ""), IsEmpty());
}

TEST_F(VersionNotesTest, AChannelOfAnotherVersionIsNamedWithWhoMadeTheLog) {
  add(log::joint_event(0), false);
  add(log::motion_event(0, "standing"), true);
  EXPECT_THAT(
      version_notes(frames_, "0.9 (abc)"),
      ElementsAre("MOTION_STATE is of another version of its message: its values are missing; use the "
                  "sprung that made the log: 0.9 (abc)."));
}

TEST_F(VersionNotesTest, OfAMixedChannelTheyAreCounted) {
  add(log::joint_event(0), false);
  add(log::joint_event(1), true);
  EXPECT_THAT(version_notes(frames_, ""), ElementsAre(HasSubstr("1 of 2 messages of JOINT_STATE")));
}

TEST_F(VersionNotesTest, APoseIsMissingForAReason) {
  EXPECT_THAT(no_pose(frames_, ""), HasSubstr("there is no JOINT_STATE"));
  add(log::joint_event(0), true);
  EXPECT_THAT(no_pose(frames_, ""), HasSubstr("JOINT_STATE is of another version"));
  add(log::joint_event(1), false);
  EXPECT_THAT(no_pose(frames_, ""), HasSubstr("no joint has a position"));
}

}  // namespace
}  // namespace sprung::station
