#include "tools/operate/launcher/build_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

sprung_msgs::process_status_t planner() {
  sprung_msgs::process_status_t status{};
  status.process = "sprung-motion-planner";
  status.host = "trunk";
  status.version = "0.1.0";
  status.git_hash = "abc";
  status.types_hash = 1;
  status.configuration_hash = 2;
  status.robot = "pegasus";
  status.clock = "realtime";
  return status;
}

class BuildMatch : public testing::Test {
 protected:
  std::string verdict(bool mixed = false) const { return why_not_together(ours_, theirs_, mixed); }
  const BuildIdentity ours_ = identity_of(planner());
  sprung_msgs::process_status_t theirs_ = planner();
};

TEST_F(BuildMatch, SameGoesTogether) { EXPECT_EQ(verdict(), ""); }

TEST_F(BuildMatch, OtherVersionIsNamedWithProcessHostAndBothValues) {
  theirs_.version = "0.2.0";
  EXPECT_THAT(verdict(), AllOf(HasSubstr("sprung-motion-planner on trunk"), HasSubstr("version"),
                               HasSubstr("0.2.0"), HasSubstr("0.1.0")));
  EXPECT_NE(verdict(true), "");
}

TEST_F(BuildMatch, OtherBuildIsRefusedUnlessADeveloperLetsIt) {
  theirs_.git_hash = "def+changes";
  EXPECT_THAT(verdict(), AllOf(HasSubstr("def+changes"), HasSubstr("abc"), HasSubstr("SPRUNG_MIXED_BUILDS")));
  EXPECT_EQ(verdict(true), "");
}

TEST_F(BuildMatch, OtherMessageTypesAreRefusedAlways) {
  theirs_.types_hash = 255;
  EXPECT_THAT(verdict(true), AllOf(HasSubstr("message types"), HasSubstr("00000000000000ff")));
}

TEST_F(BuildMatch, OtherRobotFileIsRefusedAlways) {
  theirs_.configuration_hash = 3;
  EXPECT_THAT(verdict(true), AllOf(HasSubstr("configuration"), HasSubstr("robot.yaml")));
}

TEST_F(BuildMatch, OtherRobotOrClockIsRefused) {
  theirs_.clock = "lockstep";
  EXPECT_THAT(verdict(), HasSubstr("--clock"));
  theirs_.robot = "fennec";
  EXPECT_THAT(verdict(), HasSubstr("fennec"));
}

}  // namespace
}  // namespace sprung
